#pragma once
// The page of a model before it is run, for the viewer (viewer/README.md): its bodies, joints, axes
// and forces in the configuration that a run starts from.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/model/system_state.hpp"
#include "floatframe/report/run_report.hpp"

namespace floatframe {

/// Where a run of the model begins, and what is said of it.
struct CheckedStart {
  SystemState state{};  ///< without bodies: the design configuration
  std::vector<std::string> notes;
  std::vector<FactTable> facts;
  std::vector<PageTable> tables;  ///< of the model; those of joints and forces are added
  std::string failure;            ///< why a run cannot start
};

/// Needs a program that was built with the viewer.
std::string check_page(const Model& model, const CheckedStart& start);

/// Throws InputError, which names the option, if the program was built without the viewer.
void require_page(const std::string& option);

}  // namespace floatframe
