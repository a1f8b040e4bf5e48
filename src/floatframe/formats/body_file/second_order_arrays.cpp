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

}  // namespace

void add_second_order(const FlexibleBody& body, NamedBytes& arrays) {
  const Eigen::Index nm = body.modes();
  const auto add = [&](const char* name, const MatX& stack) {
    arrays.emplace_back(name, npy_bytes(grouped_array(stack, static_cast<std::size_t>(nm))));
  };
  if (nm > 0 && body.projection && body.projection->h.size() > 0)
    add("projection_h", body.projection->h);
  if (nm == 0 || !body.second_order) return;
  const SecondOrder& s = *body.second_order;
  const auto count = static_cast<Eigen::Index>(s.nodes.size());
  MatX S(3 * nm, nm), Si(9 * nm, nm), h(3 * count * nm, nm), theta(3 * count * nm, nm);
  std::vector<std::int32_t> nodes;
  for (Eigen::Index j = 0; j < 3; ++j) {
    put(s.S2[j], S, j);
    for (Eigen::Index i = 0; i < 3; ++i) put(s.S2i[i][j], Si, 3 * i + j);
    for (Eigen::Index k = 0; k < count; ++k) {
      put(s.nodes[k].h[j], h, 3 * k + j);
      put(s.nodes[k].theta[j], theta, 3 * k + j);
    }
  }
  for (const SecondOrderNode& node : s.nodes) nodes.push_back(node.node);
  add("second_order_S", S);
  add("second_order_Si", Si);
  arrays.emplace_back("second_order_nodes", npy_bytes({{nodes.size()}, std::move(nodes)}));
  add("second_order_h", h);
  add("second_order_theta", theta);
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
    arrays.error("second_order_nodes", "expected markers in ascending order, each once");
  const Eigen::Index count = arrays.length("second_order_nodes");
  nodes.resize(static_cast<std::size_t>(count));  // zeros after an error
  const MatX h = arrays.grouped("second_order_h", 3 * count, nm, nm);
  const MatX theta = arrays.grouped("second_order_theta", 3 * count, nm, nm);
  auto out = std::make_shared<SecondOrder>();
  for (const int node : nodes) out->nodes.emplace_back().node = node;
  for (Eigen::Index j = 0; j < 3; ++j) {
    out->S2[j] = taken(S, j);
    for (Eigen::Index i = 0; i < 3; ++i) out->S2i[i][j] = taken(Si, 3 * i + j);
    for (Eigen::Index k = 0; k < count; ++k) {
      out->nodes[k].h[j] = taken(h, 3 * k + j);
      out->nodes[k].theta[j] = taken(theta, 3 * k + j);
    }
  }
  return out;
}

MatX read_projection_h(ArrayReader& arrays, Eigen::Index nm, Eigen::Index nodes) {
  if (nm == 0 || !arrays.has("projection_h")) return {};
  return arrays.grouped("projection_h", 3 * nodes, nm, nm);
}

void check_second_order(const FlexibleBody& body, ArrayReader& arrays) {
  const auto check = [&](const char* name, const MatX& m, double size, Eigen::Index place) {
    const double off = (m - m.transpose()).cwiseAbs().maxCoeff();
    if (off <= symmetric_to * size) return true;
    arrays.error(name, fmt::format("matrix {} is not symmetric: two of its entries differ by {:g}",
                                   place + 1, off));
    return false;
  };
  const auto check_all = [&](const char* name, const std::vector<const MatX*>& all) {
    double size = 0.0;
    for (const MatX* m : all) size = std::max(size, m->cwiseAbs().maxCoeff());
    for (std::size_t k = 0; k < all.size(); ++k)
      if (!check(name, *all[k], size, static_cast<Eigen::Index>(k))) return;
  };
  if (body.modes() == 0) return;
  if (const auto& s = body.second_order) {
    std::vector<const MatX*> S, Si, h, theta;
    for (const MatX& m : s->S2) S.push_back(&m);
    for (const auto& row : s->S2i)
      for (const MatX& m : row) Si.push_back(&m);
    for (const SecondOrderNode& node : s->nodes) {
      for (const MatX& m : node.h) h.push_back(&m);
      for (const MatX& m : node.theta) theta.push_back(&m);
    }
    check_all("second_order_S", S);
    check_all("second_order_Si", Si);
    check_all("second_order_h", h);
    check_all("second_order_theta", theta);
  }
  if (!body.projection || body.projection->h.size() == 0) return;
  const MatX& all = body.projection->h;
  const double size = all.cwiseAbs().maxCoeff();
  for (Eigen::Index b = 0; b < all.rows() / all.cols(); ++b)
    if (!check("projection_h", taken(all, b), size, b)) return;
}

}  // namespace floatframe
