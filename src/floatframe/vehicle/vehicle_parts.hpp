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
/// The revolute joint about which a wheel spins; null: it does not. Throws InputError for a joint
/// of another type, and for one that does not turn the body on which the tyre acts.
JointDescription* spin_joint(ModelDescription& d, const VehicleWheel& wheel);
/// The body of the tyre is the parent of its joint: the joint turns backwards when it rolls on.
bool spins_as_parent(const ModelDescription& d, const JointDescription& joint,
                     const VehicleWheel& wheel);
/// With its place where it is known: `path` is "vehicle.axles".
InputError vehicle_error(const ModelDescription& d, ErrorCode code, const std::string& path,
                         const std::string& text);

}  // namespace floatframe
