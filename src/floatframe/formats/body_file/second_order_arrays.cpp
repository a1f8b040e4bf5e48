#include "floatframe/formats/body_file/second_order_arrays.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace floatframe {
namespace {

constexpr double symmetric_to = 1e-6;  // numbers that were printed and read again

/// Matrices one below the other.
void put(const MatX& m, MatX& stack, Eigen::Index place) {
  stack.middleRows(place * m.rows(), m.rows()) = m;
}

MatX taken(const MatX& stack, Eigen::Index place) {
  return stack.middleRows(place * stack.cols(), stack.cols());
}

/// The integrals as two stacks.
std::pair<MatX, MatX> stacks_of(const SecondOrder& s) {
  const Eigen::Index nm = s.S2[0].rows();
  MatX S(3 * nm, nm), Si(9 * nm, nm);
  for (Eigen::Index j = 0; j < 3; ++j) {
    put(s.S2[j], S, j);
    for (Eigen::Index i = 0; i < 3; ++i) put(s.S2i[i][j], Si, 3 * i + j);
  }
  return {S, Si};
}

void take_integrals(const MatX& S, const MatX& Si, SecondOrder& out) {
  for (Eigen::Index j = 0; j < 3; ++j) {
    out.S2[j] = taken(S, j);
    for (Eigen::Index i = 0; i < 3; ++i) out.S2i[i][j] = taken(Si, 3 * i + j);
  }
}

/// NAME_S and NAME_Si alone.
std::shared_ptr<const SecondOrder> read_integrals(ArrayReader& arrays, const std::string& name,
                                                  Eigen::Index nm) {
  if (nm == 0 || !(arrays.has(name + "_S") || arrays.has(name + "_Si"))) return nullptr;
  auto out = std::make_shared<SecondOrder>();
  const MatX S = arrays.grouped(name + "_S", 3, nm, nm);
  take_integrals(S, arrays.grouped(name + "_Si", 9, nm, nm), *out);
  return out;
}

/// Arrays of matrices nm x nm.
class Stacks {
 public:
  Stacks(Eigen::Index nm, NamedBytes& arrays) : nm_(nm), arrays_(arrays) {}
  void add(const std::string& name, const MatX& stack) {
    arrays_.emplace_back(name, npy_bytes(grouped_array(stack, static_cast<std::size_t>(nm_))));
  }
  void add_integrals(const std::string& name, const std::shared_ptr<const SecondOrder>& s) {
    if (!s) return;
    const auto [S, Si] = stacks_of(*s);
    add(name + "_S", S);
    add(name + "_Si", Si);
  }

 private:
  Eigen::Index nm_;
  NamedBytes& arrays_;
};

void add_projection(const ProjectionData& data, Stacks& stacks, NamedBytes& arrays) {
  if (data.h.size() > 0) stacks.add("projection_h", data.h);
  stacks.add_integrals("projection_twist", data.twist);
  if (data.turning.empty()) return;
  std::vector<std::array<int, 2>> pairs;
  MatX arms(static_cast<Eigen::Index>(data.turning.size()), 3);
  for (const ProjectionData::TurningPoint& t : data.turning) {
    arms.row(static_cast<Eigen::Index>(pairs.size())) = t.arm.transpose();
    pairs.push_back({t.point, t.rotation});
  }
  arrays.emplace_back("projection_turning", npy_bytes(array_of(pairs)));
  arrays.emplace_back("projection_arms", npy_bytes(array_of(arms)));
  arrays.emplace_back("projection_rotations", npy_bytes(grouped_array(data.rotations, 3)));
}

}  // namespace

void add_second_order(const FlexibleBody& body, NamedBytes& arrays) {
  const Eigen::Index nm = body.modes();
  if (nm == 0) return;
  Stacks stacks(nm, arrays);
  if (body.projection) add_projection(*body.projection, stacks, arrays);
  stacks.add_integrals("turning", body.turning);
  if (!body.second_order) return;
  const SecondOrder& s = *body.second_order;
  stacks.add_integrals("second_order", body.second_order);
  const auto count = static_cast<Eigen::Index>(s.nodes.size());
  MatX h(3 * count * nm, nm), theta(3 * count * nm, nm);
  std::vector<std::int32_t> nodes;
  for (Eigen::Index j = 0; j < 3; ++j)
    for (Eigen::Index k = 0; k < count; ++k) {
      put(s.nodes[k].h[j], h, 3 * k + j);
      put(s.nodes[k].theta[j], theta, 3 * k + j);
    }
  for (const SecondOrderNode& node : s.nodes) nodes.push_back(node.node);
  arrays.emplace_back("second_order_nodes", npy_bytes({{nodes.size()}, std::move(nodes)}));
  stacks.add("second_order_h", h);
  stacks.add("second_order_theta", theta);
}

std::shared_ptr<const SecondOrder> read_second_order(ArrayReader& arrays, Eigen::Index nm,
                                                     Eigen::Index markers) {
  const char* members[] = {"second_order_S", "second_order_Si", "second_order_nodes",
                           "second_order_h", "second_order_theta"};
  if (nm == 0 || std::none_of(std::begin(members), std::end(members),
                              [&](const char* m) { return arrays.has(m); }))
    return nullptr;
  const MatX S = arrays.grouped("second_order_S", 3, nm, nm);
  const MatX Si = arrays.grouped("second_order_Si", 9, nm, nm);
  std::vector<int> nodes = arrays.integers("second_order_nodes", std::nullopt, markers);
  if (std::adjacent_find(nodes.begin(), nodes.end(), std::greater_equal<>()) != nodes.end())
    arrays.error(ErrorCode::duplicate, "second_order_nodes",
                 "expected markers in ascending order, each once");
  const Eigen::Index count = arrays.length("second_order_nodes");
  nodes.resize(static_cast<std::size_t>(count));  // zeros after an error
  const MatX h = arrays.grouped("second_order_h", 3 * count, nm, nm);
  const MatX theta = arrays.grouped("second_order_theta", 3 * count, nm, nm);
  auto out = std::make_shared<SecondOrder>();
  for (const int node : nodes) out->nodes.emplace_back().node = node;
  take_integrals(S, Si, *out);
  for (Eigen::Index j = 0; j < 3; ++j)
    for (Eigen::Index k = 0; k < count; ++k) {
      out->nodes[k].h[j] = taken(h, 3 * k + j);
      out->nodes[k].theta[j] = taken(theta, 3 * k + j);
    }
  return out;
}

std::shared_ptr<const SecondOrder> read_turning(ArrayReader& arrays, Eigen::Index nm) {
  return read_integrals(arrays, "turning", nm);
}

void read_projection_second_order(ArrayReader& arrays, Eigen::Index nm, ProjectionData& data) {
  if (nm == 0) return;
  const Eigen::Index nodes = data.p.cols();
  if (arrays.has("projection_h")) data.h = arrays.grouped("projection_h", 3 * nodes, nm, nm);
  data.twist = read_integrals(arrays, "projection_twist", nm);
  const char* members[] = {"projection_turning", "projection_arms", "projection_rotations"};
  if (std::none_of(std::begin(members), std::end(members),
                   [&](const char* m) { return arrays.has(m); }))
    return;
  const Eigen::Index count = arrays.length("projection_turning");
  const Eigen::Index rotations = arrays.length("projection_rotations");
  std::vector<int> pairs =
      arrays.integers("projection_turning", 2, std::max<std::int64_t>(nodes, rotations));
  pairs.resize(2 * static_cast<std::size_t>(count));  // zeros after an error
  const MatX arms = arrays.matrix("projection_arms", count, 3);
  data.rotations = arrays.grouped("projection_rotations", rotations, 3, nm);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const int point = pairs[2 * k], rotation = pairs[2 * k + 1];
    if (point >= nodes || rotation >= rotations || (k > 0 && point < data.turning.back().point)) {
      arrays.error(ErrorCode::wrong_value, "projection_turning",
                   "found point {} with rotation {} in row {}, expected points in ascending order "
                   "below {} and rotations below {}",
                   point, rotation, k + 1, nodes, rotations);
      return;
    }
    const auto row = static_cast<Eigen::Index>(k);
    data.turning.push_back({point, rotation, arms.row(row).transpose()});
  }
}

void check_second_order(const FlexibleBody& body, ArrayReader& arrays) {
  const auto check = [&](const char* name, const MatX& m, double size, Eigen::Index place) {
    const double off = (m - m.transpose()).cwiseAbs().maxCoeff();
    if (off <= symmetric_to * size) return true;
    arrays.error(ErrorCode::contradiction, name,
                 "matrix {} is not symmetric: two of its entries differ by {:g}", place + 1, off);
    return false;
  };
  const auto check_all = [&](const char* name, const std::vector<const MatX*>& all) {
    double size = 0.0;
    for (const MatX* m : all) size = std::max(size, m->cwiseAbs().maxCoeff());
    for (std::size_t k = 0; k < all.size(); ++k)
      if (!check(name, *all[k], size, static_cast<Eigen::Index>(k))) return;
  };
  const auto check_integrals = [&](const std::string& name, const SecondOrder& s) {
    std::vector<const MatX*> S, Si;
    for (const MatX& m : s.S2) S.push_back(&m);
    for (const auto& row : s.S2i)
      for (const MatX& m : row) Si.push_back(&m);
    check_all((name + "_S").c_str(), S);
    check_all((name + "_Si").c_str(), Si);
  };
  if (body.modes() == 0) return;
  if (body.turning) check_integrals("turning", *body.turning);
  if (const auto& s = body.second_order) {
    std::vector<const MatX*> h, theta;
    for (const SecondOrderNode& node : s->nodes) {
      for (const MatX& m : node.h) h.push_back(&m);
      for (const MatX& m : node.theta) theta.push_back(&m);
    }
    check_integrals("second_order", *s);
    check_all("second_order_h", h);
    check_all("second_order_theta", theta);
  }
  if (body.projection && body.projection->twist)
    check_integrals("projection_twist", *body.projection->twist);
  if (!body.projection || body.projection->h.size() == 0) return;
  const MatX& all = body.projection->h;
  const double size = all.cwiseAbs().maxCoeff();
  for (Eigen::Index b = 0; b < all.rows() / all.cols(); ++b)
    if (!check("projection_h", taken(all, b), size, b)) return;
}

}  // namespace floatframe
