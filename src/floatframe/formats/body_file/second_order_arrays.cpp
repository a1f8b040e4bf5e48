#include "floatframe/formats/body_file/body_members.hpp"

namespace floatframe {
namespace {

constexpr double symmetric_to = 1e-6;  // numbers that were printed and read again

// The stacks of matrices nm x nm, for ArrayWriter, ArrayReader and SymmetryCheck.

template <class IO, class Integrals>
void integrals(IO& io, const std::string& name, Eigen::Index nm, Integrals& s) {
  io.stack(
      name + "_S", 3, nm, nm, [&](std::size_t k) -> auto& { return s.S2[k]; });
  io.stack(
      name + "_Si", 9, nm, nm, [&](std::size_t k) -> auto& { return s.S2i[k / 3][k % 3]; });
}

template <class IO, class Nodes>
void node_matrices(IO& io, Eigen::Index nm, Nodes& nodes) {
  const auto count = 3 * static_cast<Eigen::Index>(nodes.size());
  io.stack(
      "second_order_h", count, nm,
      nm, [&](std::size_t k) -> auto& { return nodes[k / 3].h[k % 3]; });
  io.stack(
      "second_order_theta", count, nm,
      nm, [&](std::size_t k) -> auto& { return nodes[k / 3].theta[k % 3]; });
}

/// NAME_S and NAME_Si alone.
std::shared_ptr<const SecondOrder> read_integrals(ArrayReader& arrays, const std::string& name,
                                                  Eigen::Index nm) {
  if (nm == 0 || !(arrays.has(name + "_S") || arrays.has(name + "_Si"))) return nullptr;
  auto out = std::make_shared<SecondOrder>();
  integrals(arrays, name, nm, *out);
  return out;
}

void add_projection(const ProjectionData& data, Eigen::Index nm, ArrayWriter& out) {
  if (data.h.size() > 0) out.grouped("projection_h", data.h, data.h.rows() / nm, nm, nm);
  if (data.twist) integrals(out, "projection_twist", nm, *data.twist);
  if (data.turning.empty()) return;
  std::vector<std::array<int, 2>> pairs;
  for (const ProjectionData::TurningPoint& t : data.turning) pairs.push_back({t.point, t.rotation});
  out.integers("projection_turning", pairs);
  out.rows(
      "projection_arms", static_cast<Eigen::Index>(pairs.size()), [&](std::size_t k) -> auto& {
        return data.turning[k].arm;
      });
  out.grouped("projection_rotations", data.rotations, data.rotations.rows() / 3, 3, nm);
}

/// An error for the first matrix of each stack that is not symmetric.
class SymmetryCheck {
 public:
  explicit SymmetryCheck(ArrayReader& arrays) : arrays_(arrays) {}

  template <class Of>
  void stack(const std::string& name, Eigen::Index count, Eigen::Index, Eigen::Index, Of of) {
    double size = 0.0;
    for (Eigen::Index k = 0; k < count; ++k) size = std::max(size, of(k).cwiseAbs().maxCoeff());
    for (Eigen::Index k = 0; k < count; ++k) {
      const double off = (of(k) - of(k).transpose()).cwiseAbs().maxCoeff();
      if (off <= symmetric_to * size) continue;
      arrays_.error(ErrorCode::contradiction, name,
                    "matrix {} is not symmetric: two of its entries differ by {:g}", k + 1, off);
      return;
    }
  }

 private:
  ArrayReader& arrays_;
};

}  // namespace

void add_second_order(const FlexibleBody& body, ArrayWriter& out) {
  const Eigen::Index nm = body.modes();
  if (nm == 0) return;
  if (body.projection) add_projection(*body.projection, nm, out);
  if (body.turning) integrals(out, "turning", nm, *body.turning);
  if (!body.second_order) return;
  const SecondOrder& s = *body.second_order;
  integrals(out, "second_order", nm, s);
  std::vector<int> nodes;
  for (const SecondOrderNode& node : s.nodes) nodes.push_back(node.node);
  out.integers("second_order_nodes", nodes);
  node_matrices(out, nm, s.nodes);
}

std::shared_ptr<const SecondOrder> read_second_order(ArrayReader& arrays, Eigen::Index nm,
                                                     Eigen::Index markers) {
  if (nm == 0 || !arrays.has_any({"second_order_S", "second_order_Si", "second_order_nodes",
                                  "second_order_h", "second_order_theta"}))
    return nullptr;
  auto out = std::make_shared<SecondOrder>();
  integrals(arrays, "second_order", nm, *out);
  std::vector<int> nodes = arrays.integers("second_order_nodes", std::nullopt, markers);
  if (std::adjacent_find(nodes.begin(), nodes.end(), std::greater_equal<>()) != nodes.end())
    arrays.error(ErrorCode::duplicate, "second_order_nodes",
                 "expected markers in ascending order, each once");
  nodes.resize(
      static_cast<std::size_t>(arrays.length("second_order_nodes")));  // zeros after an error
  for (const int node : nodes) out->nodes.emplace_back().node = node;
  node_matrices(arrays, nm, out->nodes);
  return out;
}

std::shared_ptr<const SecondOrder> read_turning(ArrayReader& arrays, Eigen::Index nm) {
  return read_integrals(arrays, "turning", nm);
}

void read_projection_second_order(ArrayReader& arrays, Eigen::Index nm, ProjectionData& data) {
  if (nm == 0) return;
  const Eigen::Index nodes = data.p.cols();
  if (arrays.has("projection_h")) arrays.grouped("projection_h", data.h, 3 * nodes, nm, nm);
  data.twist = read_integrals(arrays, "projection_twist", nm);
  if (!arrays.has_any({"projection_turning", "projection_arms", "projection_rotations"})) return;
  const Eigen::Index count = arrays.length("projection_turning");
  const Eigen::Index rotations = arrays.length("projection_rotations");
  auto pairs = arrays.integers<2>("projection_turning", std::max<std::int64_t>(nodes, rotations));
  pairs.resize(static_cast<std::size_t>(count));  // zeros after an error
  const MatX arms = arrays.matrix("projection_arms", count, 3);
  arrays.grouped("projection_rotations", data.rotations, rotations, 3, nm);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto [point, rotation] = pairs[k];
    if (point >= nodes || rotation >= rotations || (k > 0 && point < data.turning.back().point))
      return arrays.error(
          ErrorCode::wrong_value, "projection_turning",
          "found point {} with rotation {} in row {}, expected points in ascending order "
          "below {} and rotations below {}",
          point, rotation, k + 1, nodes, rotations);
    data.turning.push_back({point, rotation, arms.row(k).transpose()});
  }
}

void check_second_order(const FlexibleBody& body, ArrayReader& arrays) {
  const Eigen::Index nm = body.modes();
  if (nm == 0) return;
  SymmetryCheck check(arrays);
  if (body.turning) integrals(check, "turning", nm, *body.turning);
  if (body.second_order) {
    integrals(check, "second_order", nm, *body.second_order);
    node_matrices(check, nm, body.second_order->nodes);
  }
  if (!body.projection) return;
  if (body.projection->twist) integrals(check, "projection_twist", nm, *body.projection->twist);
  const MatX& h = body.projection->h;
  check.stack("projection_h", h.rows() / nm, nm, nm,
              [&](Eigen::Index k) { return h.middleRows(k * nm, nm); });
}

}  // namespace floatframe
