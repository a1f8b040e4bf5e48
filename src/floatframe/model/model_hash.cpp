#include "floatframe/model/model_hash.hpp"

#include <bit>

#include "floatframe/core/content_hash.hpp"
#include "floatframe/model/element_keys.hpp"
#include "floatframe/model/slide_path.hpp"

namespace floatframe {
namespace {

// Every structure is decomposed by a structured binding: after a new member this does not compile
// until it is decided whether it affects the motion.
class ModelHash {
 public:
  std::string text() const { return hash_.text(); }

  void add(double x) { hash_.add(std::bit_cast<std::uint64_t>(x)); }
  void add(int n) { hash_.add(static_cast<std::uint64_t>(n)); }
  void add(bool b) { hash_.add(std::uint64_t{b}); }
  void add(const std::string& text) { hash_.add(text); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(Enum e) { add(static_cast<int>(e)); }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& m) {
    add(static_cast<int>(m.rows()));
    for (Eigen::Index j = 0; j < m.cols(); ++j)
      for (Eigen::Index i = 0; i < m.rows(); ++i) add(static_cast<double>(m(i, j)));
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(static_cast<int>(list.size()));
    for (const T& x : list) add(x);
  }
  template <class... T>
  void all(const T&... x) {
    (add(x), ...);
  }

  void add(const Pose& X) {
    const auto& [p, R] = X;
    all(p, R);
  }
  void add(const PiecewisePolynomial::Piece& piece) {
    const auto& [centre, coefficients] = piece;
    all(centre, coefficients);
  }
  void add(const PiecewisePolynomial& f) { all(f.breaks(), f.pieces()); }
  void add(const SineTerm& s) {
    const auto& [amplitude, frequency, phase, rate, start, duration] = s;
    all(amplitude, frequency, phase, rate, start, duration);
  }
  void add(const TimeFunction& f) {
    const auto& [pieces, sines, period, formula] = f;
    all(pieces, sines, period, formula);
  }
  void add(const CosineBump& b) {
    const auto& [start, length, height] = b;
    all(start, length, height);
  }
  void add(const Road& r) {
    const auto& [name, pieces, bumps, surface] = r;
    all(pieces, bumps);
    if (surface) add(*surface);
  }
  void add(const RoadSurface& s) {
    const auto& [height, grid, crg, tracks, friction, patches] = s;
    all(height, grid != nullptr, crg != nullptr, tracks != nullptr, friction);
    if (grid) add(*grid);
    if (crg) add(*crg);
    if (tracks) all(tracks->left, tracks->right, tracks->width, tracks->centre);
    for (const auto& [x0, x1, y0, y1, factor] : patches) all(x0, x1, y0, y1, factor);
  }
  void add(const HeightGrid& g) {
    const auto& [x, y, interpolation, outside, z, zx, zy, zxy] = g;
    all(x, y, interpolation, outside, z);  // the slopes follow from these
  }
  void add(const CrgRoad& c) {
    const auto& [line, v, uniform, singles, doubles, heights, banking, edge_u, edge_v,
                 interpolation, notes] = c;
    all(line.first(), line.step(), v, doubles, heights, banking, interpolation);
    for (const float z : singles) add(static_cast<double>(z));
    for (const CrgEdge& edge : {edge_u, edge_v}) all(edge.mode, edge.offset);
    for (std::size_t k = 0; k < c.rows(); ++k) all(line.node(k).x, line.node(k).y);
  }
  void add(const Marker& m) {
    const auto& [body, node, X_NM, rotates, path, guide] = m;
    if (path) all(guide, path->points());
    all(body, node >= 0, X_NM, rotates);  // the node itself: below
  }
  void add(const Joint& j) {
    const auto& [name, type, parent, child, F, M, axis_2, position, velocity, keep, motion, motions,
                 cut, automatic] = j;
    all(name, type, parent, child, F, M, axis_2, motion, motions, cut, automatic);
  }
  void add(const AttachmentDescription& a) { all(a.body, a.point, a.node.value_or("")); }
  void add(const SignalDescription& s) {
    add(static_cast<const TimeFunction&>(s));
    all(s.input, s.source, s.element, s.value, s.factor);
  }
  void add(const SharedFormula& f) {
    if (!f) return;
    add(f->text);
    for (const FormulaStep& step : f->steps) add(step.number);  // also where the text is older
    for (const auto& curve : f->curves) add(*curve);
    for (const auto& grid : f->grids) all(grid->x, grid->y, grid->values);
  }
  void add(const CoordinateTerm& t) { all(t.joint, t.coordinate, t.factor); }
  void add(const ForceFunction& f) { all(f.identity(), f.formula()); }
  void add(const Signal& s) {
    const auto& [function, input, link, given, differentiated, local] = s;
    all(function, input, link, given);
  }
  void add(const SignalLink& l) {
    const auto& [from, to, port, quantity, factor, value] = l;
    all(from, to, port, quantity, factor, value);
  }
  void add(const FormulaOperand& x) {
    const auto& [kind, index, output, factor, offset, ports, angle] = x;
    all(kind, index, output);
    if (factor != 1.0 || offset != 0.0) all(factor, offset);
  }
  void add(const Element& e) {
    const auto& [name, type, markers, laws, signals, coordinates, operands, load, values, road,
                 states, kept, clock, rates_first, remembers, start, acts, holds, reads, rotational,
                 driven, jumps, switched, keys, data] = e;
    all(name, type, markers, laws, signals, operands, road, rotational);
    if (remembers) all(kept);
    const ElementDescription described{name, *keys, {}};
    for (const ElementKey& key : element_keys(type))
      if (const auto value = key_value(described, key))
        std::visit([&](const auto& x) { add(x); }, *value);
  }
  void add(const Input& i) {
    const auto& [name, unit, initial, low, high, clamp] = i;
    all(name, low, high, clamp);
  }
  void add(const Output& o) {
    const auto& [name, unit, type, marker, to, body, joint, element, component, gauge, relative,
                 axes, factor, formula] = o;
    all(name, type, marker, to, body, joint, element, component);
    if (gauge >= 0) all(gauge);
    if (relative >= 0 || axes >= 0) all(relative, axes);
    if (formula) all(formula->formula, formula->operands);
  }
  void add(const Gauge& g) {
    const auto& [body, place, section, inertia_loads, direction, modes, loads] = g;
    all(body, place, section, inertia_loads, direction);
  }
  void add(const InertiaInvariants& v) {
    const auto& [m, m_u, P_u, S, Si, Sij] = v;
    all(m, m_u, P_u, S);
    for (const Mat3X& s : Si) add(s);
    for (const auto& row : Sij)
      for (const MatX& s : row) add(s);
  }
  void add(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix) {
    all(static_cast<int>(matrix.rows()), static_cast<int>(matrix.nonZeros()));
    for (int k = 0; k < matrix.outerSize(); ++k)
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(matrix, k); it; ++it)
        all(static_cast<int>(it.col()), it.value());
  }
  void add(const ProjectionData& d) {
    const auto& [p, X, M_s, X_theta, M_6, h, turning, rotations, twist] = d;
    all(p, X, M_s, X_theta, M_6, rotations);
    for (const auto& [point, rotation, arm] : turning) all(point, rotation, arm);
    if (twist) add(*twist);
  }
  void add(const SecondOrder& s) {
    const auto& [S2, S2i, nodes] = s;
    for (const MatX& m : S2) add(m);
    for (const auto& row : S2i)
      for (const MatX& m : row) add(m);
  }
  void add(const SecondOrderNode& n) {
    const auto& [node, h, theta] = n;
    for (std::size_t j = 0; j < 3; ++j) all(h[j], theta[j]);
  }
  void add(const FlexibleBody& body) {
    const auto& [invariants, K, D, nodes, projection, mass_model, turning, second_order,
                 frequencies, equal_left_out, mode_names, shape, stress, interfaces] = body;
    all(invariants, K, D, mass_model);  // nodes: those with markers
    if (projected_ && projection) add(*projection);
    if (turning) add(*turning);
  }
  void add(const Body& b) {
    const auto& [name, data, X_WB, length, geometric_stiffening, stiffening_given] = b;
    all(name, *data, X_WB, length);
    if (b.stiffens()) add(*data->second_order);
  }
  void add(const ModalNode& n) {
    const auto& [name, p, X, X_theta] = n;
    all(p, X, X_theta);
  }
  void add(const Model& model) {
    const auto& [name, gravity, bodies, joints, elements, links, roads, inputs, markers, outputs,
                 measures, until, gauges, amplitudes, amplitude_rates, mean_mass, simulation,
                 vehicle, hints, linear] = model;  // manoeuvres read `vehicle`, no step does
    projected_ = simulation.inertia == InertiaMethod::projection;
    all(gravity, bodies, joints, elements, links, roads, inputs, markers, outputs, mean_mass);
    for (const Output& o : measures) add(o);
    if (until) add(*until);
    for (const Gauge& g : gauges) add(g);
    for (const Marker& m : markers)
      if (m.body >= 0 && m.node >= 0) add_node(bodies[m.body], m.node);
    for (const Marker& m : markers)
      if (m.path)
        for (const int node : m.path->nodes()) add_node(bodies[m.body], node);
  }
  void add_node(const Body& body, int node) {
    add(body.data->nodes[node]);
    if (!body.stiffens()) return;
    for (const SecondOrderNode& n : body.data->second_order->nodes)
      if (n.node == node) add(n);
  }

 private:
  ContentHash hash_;
  bool projected_ = false;  ///< data of the projection method matter
};

}  // namespace

std::string model_hash(const Model& model) {
  ModelHash hash;
  hash.add(model);
  return hash.text();
}

}  // namespace floatframe
