#include "step_callback.hpp"

#include <cmath>

namespace floatframe::python {
namespace {

using Line = nb::ndarray<nb::numpy, double, nb::ndim<1>>;
using Kept = std::shared_ptr<std::vector<double>>;

nb::object line_of(const Kept& numbers) {
  auto kept = std::make_unique<Kept>(numbers);
  nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<Kept*>(p); });
  kept.release();
  return nb::cast(Line(numbers->data(), {numbers->size()}, owner));
}

/// Replaces the view if the user has modified the array object.
void keep_line(nb::object& array, const Kept& numbers) {
  Line line;
  if (!nb::try_cast(array, line) || line.data() != numbers->data() ||
      line.shape(0) != numbers->size())
    array = line_of(numbers);
}

bool is_mapping(const nb::handle value) {
  return PyObject_IsInstance(value.ptr(),
                             nb::module_::import_("collections.abc").attr("Mapping").ptr()) == 1;
}

}  // namespace

double period_of(const nb::handle value) {
  if (value.is_none()) return 0.0;
  const double period = number("period", value);
  if (!(period > 0.0) || !std::isfinite(period))
    throw InputError(ErrorCode::out_of_range, "period: found " + std::to_string(period) +
                                                  ", expected a positive number of seconds");
  return period;
}

StepCallback::StepCallback(nb::object function, std::vector<std::string> inputs,
                           std::size_t outputs, double period)
    : function_(std::move(function)),
      names_(std::move(inputs)),
      period_(period),
      seen_numbers_(std::make_shared<std::vector<double>>(outputs)),
      changed_numbers_(std::make_shared<std::vector<double>>(names_.size())) {
  if (!PyCallable_Check(function_.ptr()))
    throw InputError(ErrorCode::wrong_value,
                     "on_step: found " + type_of(function_) +
                         ", expected a function of (time, outputs, inputs), or None");
  for (std::size_t k = 0; k < names_.size(); ++k) index_.emplace(names_[k], k);
  seen_ = line_of(seen_numbers_);
  changed_ = line_of(changed_numbers_);
}

void StepCallback::operator()(double time, std::span<const double> outputs,
                              std::span<double> inputs) {
  if (period_ > 0.0) {
    // Instants are compared within a millionth of the period; a state before the last one, or far
    // behind it, begins anew.
    const double slack = 1e-6 * period_;
    if (called_ && time < next_ - slack && time >= next_ - period_ - slack) return;
    const bool late = !called_ || std::abs(time - next_) > slack;
    next_ = (late ? time : next_) + period_;
    called_ = true;
  }
  std::copy(outputs.begin(), outputs.end(), seen_numbers_->begin());
  std::copy(inputs.begin(), inputs.end(), changed_numbers_->begin());
  keep_line(seen_, seen_numbers_);
  keep_line(changed_, changed_numbers_);
  const nb::object returned = function_(time, seen_, changed_);
  if (!returned.is_none()) take(returned, *changed_numbers_);
  std::copy_n(changed_numbers_->begin(), inputs.size(), inputs.begin());
}

void StepCallback::take(const nb::object& returned, std::span<double> inputs) const {
  if (!PyDict_Check(returned.ptr()) && !is_mapping(returned))
    throw InputError(ErrorCode::wrong_value,
                     "on_step: the function returned " + type_of(returned) +
                         ", expected a map of names and values of inputs, or None");
  const nb::object pairs = returned.attr("items")();
  for (const nb::handle pair : pairs) {
    const std::string name = text("on_step, name of an input", pair[0]);
    const auto at = index_.find(name);
    if (at == index_.end()) {
      std::string known;
      for (const std::string& n : names_) known += (known.empty() ? "" : ", ") + n;
      throw UnknownName(ErrorCode::not_found, "on_step: found no input '" + name +
                                                  "', expected one of " +
                                                  (known.empty() ? "none" : known));
    }
    inputs[at->second] = number("input '" + name + "'", pair[1]);
  }
}

}  // namespace floatframe::python
