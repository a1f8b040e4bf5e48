#pragma once
// What a user says about a system (ModelDescription), by hand or from a model file, and the system
// that is built from it (Model): immutable, shared by threads, to be read and not to be filled.
// Packed into one file it is loaded without its model file (PackedModel).
// Roads are asked for their height above a place (surface_at); read_crg reads measured ones.
#include "floatframe/description/description.hpp"
#include "floatframe/description/road_spectrum.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/model/road.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "floatframe/model_file/model_values.hpp"
#include "floatframe/model_file/pack_model.hpp"
#include "floatframe/roads/crg_file.hpp"
