#pragma once
// What manoeuvres and rigs find in a description and add to it, by the words of model files.
#include <string>
#include <string_view>

#include "floatframe/description/description.hpp"

namespace floatframe {

/// Throws InputError if there is none of this name.
const BodyDescription& vehicle_body(const ModelDescription& d, const std::string& name);
/// An output or joint of this type; the type is known.
OutputDescription output_of_type(std::string name, std::string_view type);
JointDescription joint_of_type(std::string name, std::string_view type);
/// The revolute joint about which a wheel spins; null: there is none.
JointDescription* spin_joint(ModelDescription& d, const std::string& name);

}  // namespace floatframe
