#pragma once
// What elements exert and where joints stand at the frames of a scene: the wrench of each element
// on one of the bodies it acts on, its results (force, length, rate, further values), and the
// coordinates of joints. For arrows and for the values of what is selected.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/page/page_writer.hpp"

namespace floatframe {

struct SystemMotion;

struct SceneEfforts {
  /// A number with a name, as a column of `numbers`.
  struct Value {
    std::string name, unit;  ///< unit of SI; empty: none
    int column = 0;
  };
  struct OfElement {
    int port = -1;  ///< the marker of the element that the wrench acts on, of its list; -1: none
    int wrench =
        -1;  ///< first of its columns: force [N], torque about the marker [N m], world axes
    std::vector<Value> values;
  };
  std::vector<OfElement> elements;         ///< of the model
  std::vector<std::vector<Value>> joints;  ///< of the model; angles count their turns
  int columns = 0;
  std::vector<double> numbers;  ///< frames x columns; not finite: there is no value
  std::vector<char> constant;   ///< columns whose number is the same at all frames

  bool empty() const noexcept { return numbers.empty(); }
};

/// Collects them, frame by frame.
class EffortCollector {
 public:
  explicit EffortCollector(const Model& model);
  /// There is nothing to collect.
  bool empty() const noexcept { return out_.columns == 0; }
  /// With forces up to date, in the order of time.
  void add(const SystemMotion& motion);
  SceneEfforts take();

 private:
  /// Value of an angle or a length, with what follows its turns.
  struct Followed {
    int joint = 0, component = 0;
    bool started = false;
    double time = 0.0, position = 0.0, rate = 0.0;
  };
  double follow(const SystemMotion& motion, Followed& f);

  const Model& model_;
  SceneEfforts out_;
  std::vector<int> results_;  ///< numbers of `Efforts::result`, of all values in their order
  std::vector<Followed> followed_;
};

/// Writes them. In the page columns that vary come first, then the constant ones.
class EffortWriter {
 public:
  explicit EffortWriter(const SceneEfforts& efforts);
  /// Null if there are none.
  nlohmann::ordered_json numbers(std::size_t frames, PageBuffer& buffer) const;
  nlohmann::ordered_json values(const std::vector<SceneEfforts::Value>& values) const;
  /// "values" of an element, and its "wrench": {"at": point, "columns": [6]}.
  void add_element(int element, int point, nlohmann::ordered_json& out) const;
  nlohmann::ordered_json values_of_joint(int joint) const;

 private:
  const SceneEfforts& efforts_;
  std::vector<int> place_;  ///< in the page, of each column
  int varying_ = 0;
};

}  // namespace floatframe
