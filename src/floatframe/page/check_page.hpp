#pragma once
// The page of a model before a run, for the viewer (viewer/README.md): its bodies, joints, axes and
// forces in the start configuration of a run.
#include <string>
#include <vector>

#include "floatframe/description/system_state.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/page/run_report.hpp"
#include "floatframe/page/scene_efforts.hpp"

namespace floatframe {

/// The start state of a run of the model, with notes.
struct CheckedStart {
  SystemState state{};  ///< without bodies: the design configuration
  std::vector<std::string> notes;
  std::vector<FactTable> facts;
  std::vector<PageTable> tables;  ///< of the model; tables of joints and forces are added
  std::string failure;            ///< reason why a run cannot start
  SceneEfforts efforts{};         ///< at the start; may be empty
};

/// Requires a program built with the viewer.
std::string check_page(const Model& model, const CheckedStart& start);

/// Throws InputError with the name of the option if the program was built without the viewer.
void require_page(const std::string& option);

}  // namespace floatframe
