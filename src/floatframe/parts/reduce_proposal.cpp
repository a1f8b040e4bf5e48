#include "floatframe/parts/reduce_proposal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/springs.hpp"
#include "floatframe/fe/unit_system.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/parts/beam_arms.hpp"
#include "floatframe/parts/part_options.hpp"
#include "floatframe/parts/part_text.hpp"
#include "floatframe/reduction/connectivity.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_interfaces = 24;
constexpr int most_trials = 200;

struct Candidate {
  InterfaceDescription interface;
  std::size_t nodes = 0;
};

/// Letters, digits, `_` and `-`, so that models, results and shells accept it unchanged.
std::string plain_name(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '_' || c == '-';
    if (plain || (!out.empty() && out.back() != '_')) out += plain ? c : '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty() || (out[0] >= '0' && out[0] <= '9') || out[0] == '-') out = "I" + out;
  return out;
}

InterfaceDescription at_set(const std::string& name) {
  InterfaceDescription out;
  out.name = plain_name(name);
  out.choice.by = NodeChoice::By::set;
  out.choice.set = name;
  return out;
}

/// True if the command line can express the interface.
bool can_be_written(const InterfaceDescription& d) {
  try {
    const InterfaceDescription again = interface_argument(interface_text(d));
    return again.name == d.name && again.choice.by == d.choice.by &&
           again.choice.set == d.choice.set && again.choice.number == d.choice.number;
  } catch (const InputError&) {
    return false;
  }
}

/// Candidates of the first group, then of the second.
std::vector<Candidate> candidates(const FeModel& model, bool elements) {
  std::vector<Candidate> out;
  const DofTable table = dof_table(model);
  std::size_t used = 0;  // number of nodes of the part
  for (int k = 0; k < model.nodes(); ++k) used += table.count(k) > 0 ? 1 : 0;
  const auto add = [&](const std::string& name) {
    Candidate c{at_set(name)};
    try {
      c.nodes = choose_nodes(model, c.interface.choice).size();
    } catch (const InputError&) {  // an empty set
      return;
    }
    if (2 * c.nodes <= used) out.push_back(std::move(c));
  };
  if (elements) {
    for (const auto& [name, set] : model.element_sets) add(name);
  } else {
    for (const auto& [name, set] : model.node_sets) add(name);
    for (const auto& [name, set] : model.surfaces)
      if (!model.node_sets.contains(name) && !model.element_sets.contains(name)) add(name);
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const Candidate& a, const Candidate& b) { return a.nodes < b.nodes; });
  return out;
}

/// A copy of the model to which the interfaces are added.
class Trial {
 public:
  explicit Trial(const FeModel& model) : model_(model) {}

  bool accept(InterfaceDescription d) {
    if (accepted_.size() >= most_interfaces || trials_++ >= most_trials) return false;
    const std::string name = d.name;
    for (int k = 2; model_.find_node(d.name) >= 0; ++k) d.name = fmt::format("{}_{}", name, k);
    if (!can_be_written(d)) return false;
    const std::size_t nodes = model_.positions.size();
    int node = -1;
    try {
      node = add_interface(model_, d);
    } catch (const InputError&) {
      return false;
    }
    const bool added = model_.positions.size() > nodes;
    const auto known = std::find(nodes_.begin(), nodes_.end(), node);
    if (known == nodes_.end() && have_independent_dofs(node) && moves_something(node)) {
      accepted_.push_back(std::move(d));
      nodes_.push_back(node);
      return true;
    }
    if (added)
      undo();
    else  // it continues under the name of the first
      model_.node_names[node] = known == nodes_.end() ? "" : accepted_[known - nodes_.begin()].name;
    return false;
  }

  const std::vector<InterfaceDescription>& accepted() const { return accepted_; }
  const FeModel& model() const { return model_; }

 private:
  /// False if the spider of the new interface takes dofs of the node or of those accepted before.
  bool have_independent_dofs(int node) const {
    const DofTable table = dof_table(model_);
    try {
      const DependentDofs dofs = resolve_dependences(model_, table);
      const auto own = [&](int k) {
        const auto first = dofs.dependent.begin() + table.begin[k];
        return table.count(k) == 6 &&
               std::none_of(first, first + 6, [](char dependent) { return dependent != 0; });
      };
      return own(node) && std::all_of(nodes_.begin(), nodes_.end(), own);
    } catch (const InputError&) {
      return false;
    }
  }

  /// For the reference of a rigid spider: true if a dependent node resists each of its motions.
  bool moves_something(int node) const {
    const auto without = dofs_without_springs(model_);
    const auto own = [&](int k) { return without[static_cast<std::size_t>(k) + 1]; };
    Mat6 A = Mat6::Zero();
    bool rigid = false;
    for (const Spider& s : model_.spiders) {
      if (s.reference != node) continue;
      if (s.kind == Spider::Kind::mean) return true;
      rigid = true;
      double size = 0.0;
      for (const int k : s.nodes)
        size = std::max(size, (model_.positions[k] - model_.positions[node]).norm());
      if (!(size > 0.0)) size = 1.0;
      for (const int k : s.nodes) {
        const Vec3 r = (model_.positions[k] - model_.positions[node]) / size;
        Mat6 motion = Mat6::Identity();
        motion.block<3, 3>(0, 3) = -skew(r);
        for (int axis = 0; axis < 6; ++axis)
          if (((s.mask >> axis) & 1u) != 0 && axis < own(k))
            A += motion.row(axis).transpose() * motion.row(axis);
      }
    }
    if (!rigid || is_used_by_elements(node, true)) return true;
    if (is_used_by_elements(node, false)) A.topLeftCorner<3, 3>() += Mat3::Identity();
    const VecX e = symmetric_eigenvalues(A);
    return e(0) > 1e-10 * e(5);
  }

  /// `turning`: by beams or shells.
  bool is_used_by_elements(int node, bool turning) const {
    return std::any_of(model_.elements.begin(), model_.elements.end(), [&](const FeElement& e) {
      if (turning && !is_beam(e.type) && !is_shell(e.type)) return false;
      const auto last = e.nodes.begin() + element_nodes(e.type);
      return std::find(e.nodes.begin(), last, node) != last;
    });
  }

  void undo() {
    model_.positions.pop_back();
    model_.spiders.pop_back();
    const auto shorten = [&](auto& values) {
      if (values.size() > model_.positions.size()) values.resize(model_.positions.size());
    };
    shorten(model_.node_ids);
    shorten(model_.node_sources);
    shorten(model_.node_names);
  }

  FeModel model_;
  std::vector<InterfaceDescription> accepted_;
  std::vector<int> nodes_;  ///< nodes of the accepted interfaces
  int trials_ = 0;
};

InterfaceDescription at_node(const FeModel& model, int node, const std::string& name) {
  InterfaceDescription out;
  const std::size_t k = node;
  out.choice.by = NodeChoice::By::node;
  out.choice.number = k < model.node_ids.size() ? model.node_ids[k] : node + 1;
  out.name = name.empty() ? fmt::format("node{}", out.choice.number) : plain_name(name);
  return out;
}

/// Nodes with rotations in given matrices, if they are few: references of spiders.
std::vector<int> turning_nodes(const FeModel& model) {
  std::vector<int> out;
  if (!model.matrices) return out;
  for (const Dof& dof : model.matrices->dofs)
    if (dof.axis == 5) out.push_back(dof.node);
  if (out.size() > most_interfaces) out.clear();
  return out;
}

Trial trial_of(const FeModel& model) {
  Trial trial(model);
  std::set<int> followers;
  for (const Spider& s : model.spiders)
    if (s.kind == Spider::Kind::rigid) followers.insert(s.nodes.begin(), s.nodes.end());
  const std::vector<char> arms = beam_arms(model);
  for (std::size_t i = 0; i < model.spiders.size(); ++i) {
    const Spider& s = model.spiders[i];
    if (arms[i] == 0 && s.reference >= 0 && !followers.contains(s.reference))
      trial.accept(at_node(model, s.reference, s.name));
  }
  for (const int node : turning_nodes(model)) trial.accept(at_node(model, node, ""));
  for (const Candidate& c : candidates(model, false)) trial.accept(c.interface);
  if (trial.accepted().empty())
    for (const Candidate& c : candidates(model, true)) trial.accept(c.interface);
  return trial;
}

/// Number of degrees of freedom available for normal modes.
int inner_dofs(const FeModel& tied, std::size_t interfaces) {
  try {
    const DependentDofs dofs = resolve_dependences(tied, dof_table(tied));
    const auto count = std::count(dofs.dependent.begin(), dofs.dependent.end(), 0);
    return std::max(
        0, static_cast<int>(count) - 6 * static_cast<int>(std::max<std::size_t>(interfaces, 1)));
  } catch (const InputError&) {  // reported by the reduction
    return 0;
  }
}

std::string obstacle_of(const FeModel& tied) {
  if (tied.elements.empty() && tied.springs.empty() && !tied.matrices)
    return "the file has neither elements nor springs";
  try {
    check_connected(tied);
  } catch (const InputError& error) {
    return error.errors().front().text();
  }
  return "";
}

/// Quoted so that a shell takes it as one word.
std::string shell_word(const std::string& text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./:=,+@%").find(c) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string command_of(const PartJob& job, const FeModel& model,
                       const std::vector<std::string>& likely_units,
                       const std::vector<InterfaceDescription>& interfaces, int modes) {
  std::string text = "floatframe reduce " + shell_word(job.file.string());
  const auto add = [&](const std::string& option, const std::string& value) {
    text += " --" + option + (value.empty() ? "" : " " + shell_word(value));
  };
  const PartJob plain;
  add("units", likely_units.empty() ? "UNITS" : likely_units.front());
  for (const PartOption& option : part_options()) {
    if (!option.reading) continue;
    const auto texts = option_texts(option, job);
    if (texts == option_texts(option, plain)) continue;
    for (const std::string& value : texts) add(option.name, value);
  }
  if (model.materials.empty() && !model.elements.empty() && !job.read.material)
    add("material", "E,NU,RHO");
  if (!model.without_density.empty()) add("density", "RHO");
  const bool grounded = std::any_of(model.springs.begin(), model.springs.end(),
                                    [](const Spring& s) { return s.nodes[1] < 0; });
  if (grounded) add("grounded-springs", "ignore");
  if (interfaces.empty()) add("method", "free_free");
  for (const InterfaceDescription& d : interfaces) add("interface", interface_text(d));
  if (modes != default_modes) add("modes", std::to_string(modes));
  return text;
}

/// Large models are not tried: the summary of a file must not need much computation.
constexpr int most_tried_nodes = 600;

/// Reduces a small model with the interfaces; with fewer normal modes if its mass allows no more.
/// Returns the error that remains for any number of modes; empty if it is accepted.
std::string refusal_of(FeModel model, const PartJob& job, const std::string& units,
                       const std::vector<InterfaceDescription>& interfaces, int& modes) {
  if (model.nodes() > most_tried_nodes || (model.materials.empty() && !model.elements.empty()))
    return "";
  for (const auto& [material, where] : model.without_density)
    model.materials[material].density = 1000.0;
  model.without_density.clear();
  remove_grounded_springs(model);
  to_si(model, unit_system(units));
  PartOptions options;
  options.interfaces = interfaces;
  options.integration = job.options.integration;
  options.stresses = false;
  if (interfaces.empty()) options.method = ModeMethod::free_free;
  std::string refusal;
  for (int n = modes;; n /= 2) {
    options.modes = n;
    try {
      reduce_part(model, options);
      modes = n;
      return "";
    } catch (const InputError& error) {
      if (refusal.empty()) refusal = error.errors().front().text();
    }
    if (n == 0) return refusal;
  }
}

}  // namespace

ReduceProposal propose_reduction(const PartJob& job, const FeModel& model,
                                 const std::vector<std::string>& likely_units) {
  const Trial trial = trial_of(model);
  ReduceProposal out;
  out.interfaces = trial.accepted();
  const int inner = inner_dofs(trial.model(), out.interfaces.size());
  int modes = inner <= default_modes ? inner / 2 : default_modes;
  // Of a superelement all its amplitudes: they are the inner motions of the part it was made of.
  if (model.matrices && !model.matrices->scalars.empty())
    modes = static_cast<int>(model.matrices->scalars.size());
  out.obstacle = obstacle_of(trial.model());
  if (out.obstacle.empty())
    out.obstacle = refusal_of(model, job, likely_units.empty() ? "si" : likely_units.front(),
                              out.interfaces, modes);
  out.command = command_of(job, model, likely_units, out.interfaces, modes);
  return out;
}

}  // namespace floatframe
