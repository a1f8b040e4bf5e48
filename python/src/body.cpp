// Bodies: inertia integrals, modes, and the inertia terms of a moving body by both methods.
// bodies.py passes arrays of the right types with finite numbers; sizes are checked here.
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <limits>
#include <sstream>

#include "views.hpp"

namespace floatframe::python {
namespace {

using InvariantsPtr = std::shared_ptr<InertiaInvariants>;
using BodyPtr = std::shared_ptr<FlexibleBody>;
using ProjectionPtr = std::shared_ptr<ProjectionData>;

void require(bool holds, const std::string& sentence) {
  if (!holds) throw InputError(ErrorCode::wrong_value, sentence);
}

InvariantsPtr make_invariants(double m, const Vector3& m_u, const Matrix3& P_u, const AnyNumbers& S,
                              const AnyNumbers& Si, const AnyNumbers& Sij) {
  require(S.ndim() == 2 && S.shape(0) == 3, "S: expected the shape (3, modes)");
  const std::size_t nm = S.shape(1);
  require(Si.ndim() == 3 && Si.shape(0) == 3 && Si.shape(1) == 3 && Si.shape(2) == nm,
          "Si: expected the shape (3, 3, modes) with the modes of S");
  require(Sij.ndim() == 4 && Sij.shape(0) == 3 && Sij.shape(1) == 3 && Sij.shape(2) == nm &&
              Sij.shape(3) == nm,
          "Sij: expected the shape (3, 3, modes, modes) with the modes of S");
  auto v = std::make_shared<InertiaInvariants>();
  v->m = m;
  v->m_u = vec3_of(m_u);
  v->P_u = mat3_of(P_u);
  v->S = matrix_of(S.data(), 3, nm);
  for (std::size_t i = 0; i < 3; ++i) {
    v->Si[i] = matrix_of(Si.data() + i * 3 * nm, 3, nm);
    for (std::size_t j = 0; j < 3; ++j)
      v->Sij[i][j] = matrix_of(Sij.data() + (3 * i + j) * nm * nm, nm, nm);
  }
  return v;
}

Numbers3 three(const std::array<Mat3X, 3>& a, const InvariantsPtr& v) {
  return Numbers3(nb::make_tuple(matrix_view(a[0], v), matrix_view(a[1], v), matrix_view(a[2], v)));
}

Numbers3 three(const std::array<MatX, 3>& a, const InvariantsPtr& v) {
  return Numbers3(nb::make_tuple(matrix_view(a[0], v), matrix_view(a[1], v), matrix_view(a[2], v)));
}

nb::typed<nb::tuple, Numbers3, Numbers3, Numbers3> Sij_of(const InvariantsPtr& v) {
  return nb::make_tuple(three(v->Sij[0], v), three(v->Sij[1], v), three(v->Sij[2], v));
}

/// Modal translations (n, 3, nm) as 3n x nm.
MatX shapes_of(const AnyNumbers& X, std::size_t points) {
  require(X.ndim() == 3 && X.shape(0) == points && X.shape(1) == 3,
          "X: expected the shape (nodes, 3, modes) with the nodes of the positions");
  return matrix_of(X.data(), 3 * points, X.shape(2));
}

ProjectionPtr make_projection(const Points& p, const AnyNumbers& X, const Indices& rows,
                              const Indices& columns, const AnyNumbers& values) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max() / 3);
  const std::size_t n = p.shape(0);
  require(n > 0 && n < most, "p: expected the shape (nodes, 3) with at least one node");
  require(rows.size() == columns.size() && rows.size() == values.size() && values.size() < most,
          "M_s: expected a row and a column for each entry");
  auto data = std::make_shared<ProjectionData>();
  data->p = Eigen::Map<const Mat3X>(p.data(), 3, static_cast<Eigen::Index>(n));
  data->X = shapes_of(X, n);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(values.size());
  const auto size = static_cast<std::int64_t>(n);
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::int64_t i = rows.data()[k], j = columns.data()[k];
    require(i >= 0 && i < size && j >= 0 && j < size,
            "M_s: found an entry outside of the matrix of the nodes");
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), values.data()[k]);
  }
  data->M_s.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  data->M_s.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> turned = data->M_s.transpose();
  require((data->M_s - turned).norm() <= 1e-9 * data->M_s.norm(),
          "M_s: found a matrix that is not symmetric, expected the mass matrix of nodes");
  return data;
}

InvariantsPtr invariants_of_projection(const ProjectionPtr& d) {
  require(!d->six_dof(), "found masses on rotations of nodes, expected a scalar mass matrix");
  return std::make_shared<InertiaInvariants>(invariants_points(d->p, d->M_s, d->X));
}

InvariantsPtr invariants_of_mesh(const FeModel& model, const AnyNumbers& X) {
  const MatX shapes = shapes_of(X, model.positions.size());
  Unlocked released;
  validate(model);
  return std::make_shared<InertiaInvariants>(invariants_isoparametric(model, shapes));
}

ProjectionPtr projection_of_mesh(const FeModel& model, const AnyNumbers& X) {
  auto data = std::make_shared<ProjectionData>();
  data->X = shapes_of(X, model.positions.size());
  Unlocked released;
  validate(model);
  data->p.resize(3, model.nodes());
  for (int k = 0; k < model.nodes(); ++k) data->p.col(k) = model.positions[k];
  data->M_s = assemble_scalar_mass(model);
  return data;
}

MatX modal_matrix(const char* name, const AnyNumbers& a, int modes) {
  const auto nm = static_cast<std::size_t>(modes);
  require(a.ndim() == 2 && a.shape(0) == nm && a.shape(1) == nm,
          std::string(name) + ": expected the shape (modes, modes) with the modes of S");
  return matrix_of(a.data(), nm, nm);
}

/// Mass of all nodes and its first moment, from the translations of a projection.
std::pair<double, Vec3> mass_of(const ProjectionData& d) {
  const auto& M = d.six_dof() ? d.M_6 : d.M_s;
  const Eigen::Index stride = d.six_dof() ? 6 : 1;
  double mass = 0.0;
  Vec3 moment = Vec3::Zero();
  for (Eigen::Index row = 0; row < M.rows(); row += stride)
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(M, row); it; ++it) {
      if (it.col() % stride != 0) continue;
      mass += it.value();
      moment += it.value() * d.p.col(row / stride);
    }
  return {mass, moment};
}

/// Nodes of the same body: checks mass and centre (lumped masses may move the centre a little).
void require_same_body(const InertiaInvariants& v, const ProjectionData& d) {
  const auto [mass, moment] = mass_of(d);
  const auto text = [](double x) {
    std::ostringstream out;
    out << x;
    return out.str();
  };
  require(std::abs(mass - v.m) <= 1e-3 * std::abs(v.m),
          "projection: found nodes with a mass of " + text(mass) + " kg, expected " + text(v.m) +
              " kg, that of the invariants");
  const Vec3 extent = d.p.rowwise().maxCoeff() - d.p.rowwise().minCoeff();
  const double off = (moment / mass - v.m_u / v.m).norm();
  require(off <= 1e-2 * extent.norm() + 1e-9 * d.p.cwiseAbs().maxCoeff(),
          "projection: found nodes whose centre of mass is " + text(off) +
              " m from that of the invariants");
}

BodyPtr make_body(const InvariantsPtr& invariants, const std::optional<AnyNumbers>& K,
                  const std::optional<AnyNumbers>& D,
                  const std::optional<ProjectionPtr>& projection) {
  auto body = std::make_shared<FlexibleBody>();
  body->invariants = *invariants;
  const int nm = body->modes();
  body->K = K ? modal_matrix("K", *K, nm) : MatX::Zero(nm, nm);
  body->D = D ? modal_matrix("D", *D, nm) : MatX::Zero(nm, nm);
  for (int k = 1; k <= nm; ++k) body->mode_names.push_back("mode " + std::to_string(k));
  if (projection && *projection) {
    require((*projection)->X.cols() == nm,
            "projection: expected as many modes as the invariants have");
    require_same_body(body->invariants, **projection);
    body->projection = *projection;
  }
  std::string found;
  for (const InvariantError& e : check_invariants(*body, InvariantSource::parameters))
    if (K || (e.quantity != "K" && e.quantity != "D"))
      found += (found.empty() ? "" : "; ") + e.quantity + ": " + e.sentence;
  require(found.empty(), found);
  return body;
}

VecX amplitudes(const AnyNumbers& y) {
  require(y.ndim() == 1, "y, ydot: expected the shape (modes,)");
  return y.size() > 0 ? VecX(Eigen::Map<const VecX>(y.data(), static_cast<Eigen::Index>(y.size())))
                      : VecX();
}

/// As in the C++ library, but empty amplitudes are an error for a body with modes.
nb::typed<nb::tuple, RealArray, RealArray> inertia(const FlexibleBody& body, const Matrix3& A,
                                                   const AnyNumbers& y, const Vector3& omega,
                                                   const AnyNumbers& ydot, const Vector3& r0,
                                                   const std::string& method,
                                                   const std::string& coordinates,
                                                   bool stiffening) {
  BodyMotion motion;
  motion.A = mat3_of(A);
  motion.omega = vec3_of(omega);
  motion.r0 = vec3_of(r0);
  motion.y = amplitudes(y);
  motion.ydot = amplitudes(ydot);
  motion.geometric_stiffening = stiffening;
  for (const VecX* x : {&motion.y, &motion.ydot})
    require(x->size() == body.modes(), "found " + std::to_string(x->size()) +
                                           " modal amplitudes, expected " +
                                           std::to_string(body.modes()) + ": one for each mode");
  const bool projection = inertia_of(method) == InertiaMethod::projection;
  const bool absolute = coordinates_of(coordinates) == Coordinates::absolute;
  const auto terms = projection ? (absolute ? absolute_projection : relative_projection)
                                : (absolute ? absolute_preprocessing : relative_preprocessing);
  const InertiaTerms t = terms(body, motion);
  return nb::make_tuple(array_of(t.M), array_of(t.Qv));
}

using NodeArrays = nb::typed<nb::tuple, nb::str, View<double>, View<double>, View<double>>;

nb::typed<nb::list, NodeArrays> nodes_of(const BodyPtr& body) {
  nb::list out;
  for (const ModalNode& node : body->nodes)
    out.append(nb::make_tuple(node.name, view(node.p.data(), {3}, {1}, body),
                              matrix_view(node.X, body), matrix_view(node.X_theta, body)));
  return out;
}

const char* mass_model(const FlexibleBody& body) {
  const MassModel m = body.mass_model;
  return m == MassModel::isoparametric ? "isoparametric"
         : m == MassModel::six_dof     ? "six_dof"
                                       : "hermite";
}

nb::typed<nb::tuple, View<double>, View<int>, View<int>> entries_of(const ProjectionPtr& data) {
  const auto& M = data->six_dof() ? data->M_6 : data->M_s;
  const auto entries = static_cast<std::size_t>(M.nonZeros());
  const auto rows = static_cast<std::size_t>(M.outerSize());
  return nb::make_tuple(view(M.valuePtr(), {entries}, {1}, data),
                        view(M.innerIndexPtr(), {entries}, {1}, data),
                        view(M.outerIndexPtr(), {rows + 1}, {1}, data));
}

/// Shared data is never changed: Python has no access for writing.
BodyPtr shared(const std::shared_ptr<const FlexibleBody>& body) {
  return std::const_pointer_cast<FlexibleBody>(body);
}

void bind_invariants(nb::module_& m) {
  nb::class_<InertiaInvariants> c(m, "Invariants");
  c.def_ro("m", &InertiaInvariants::m);
  c.def_prop_ro("modes", &InertiaInvariants::modes);
  def_view(c, "m_u", [](const InvariantsPtr& v) { return view(v->m_u.data(), {3}, {1}, v); });
  def_view(c, "P_u", [](const InvariantsPtr& v) { return matrix_view(v->P_u, v); });
  def_view(c, "S", [](const InvariantsPtr& v) { return matrix_view(v->S, v); });
  c.def_prop_ro("Si", [](const InvariantsPtr& v) { return three(v->Si, v); });
  c.def_prop_ro("Sij", Sij_of);
  def_view(c, "centre_of_mass",
           [](const InertiaInvariants& v) { return kept(VecX(v.centre_of_mass())); });
  def_view(c, "inertia_about_origin",
           [](const InertiaInvariants& v) { return kept(MatX(v.inertia_about_origin())); });
  def_view(c, "inertia_about_centre",
           [](const InertiaInvariants& v) { return kept(MatX(v.inertia_about_centre())); });
  m.def("make_invariants", make_invariants);
  m.def("rigid_invariants", [](double mass, const Vector3& p_BC, const Matrix3& J_C) {
    return std::make_shared<InertiaInvariants>(
        InertiaInvariants::rigid(mass, vec3_of(p_BC), mat3_of(J_C)));
  });
}

void bind_projection(nb::module_& m) {
  nb::class_<ProjectionData> c(m, "Projection");
  c.def_prop_ro("six_dof", &ProjectionData::six_dof);
  def_view(c, "p", [](const ProjectionPtr& d) { return points_view(d->p, d); });
  def_view(c, "X", [](const ProjectionPtr& d) { return shapes_view(d->X, d); });
  c.def_prop_ro("mass_rows", entries_of);
  m.def("make_projection", make_projection);
  m.def("projection_of_mesh", projection_of_mesh);
  m.def("invariants_of_projection", invariants_of_projection);
  m.def("invariants_of_mesh", invariants_of_mesh);
}

}  // namespace

void bind_body(nb::module_& m) {
  bind_invariants(m);
  bind_projection(m);
  nb::class_<FlexibleBody> c(m, "Body");
  c.def_prop_ro("modes", &FlexibleBody::modes);
  c.def_prop_ro("mode_names", [](const FlexibleBody& b) { return b.mode_names; });
  c.def_prop_ro("mass_model", mass_model);
  c.def_prop_ro("invariants", [](const BodyPtr& b) { return InvariantsPtr(b, &b->invariants); });
  c.def_prop_ro("projection", [](const BodyPtr& b) {
    std::optional<ProjectionPtr> p;
    if (b->projection) p = std::const_pointer_cast<ProjectionData>(b->projection);
    return p;
  });
  def_view(c, "K", [](const BodyPtr& b) { return matrix_view(b->K, b); });
  def_view(c, "D", [](const BodyPtr& b) { return matrix_view(b->D, b); });
  def_view(c, "frequencies", [](const FlexibleBody& b) { return kept(mode_frequencies(b)); });
  c.def("damped_modes", [](const FlexibleBody& b, const std::string& reference) {
    for (const auto held :
         {DampingReference::frame, DampingReference::free, DampingReference::mounted}) {
      if (reference != word(held)) continue;
      std::vector<std::pair<double, double>> out;
      for (const DampedMode& mode : damped_modes(b, held))
        out.emplace_back(mode.frequency, mode.fraction);
      return out;
    }
    throw InputError(ErrorCode::wrong_value,
                     "reference: found '" + reference + "', expected frame, free or mounted");
  });
  c.def_prop_ro("nodes", nodes_of);
  c.def("inertia", inertia);
  m.def("make_body", make_body, nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg().none());
  m.def("part_body", [](const std::shared_ptr<BodyFile>& file) {
    return shared(std::shared_ptr<const FlexibleBody>(file, &file->part.body));
  });
}

}  // namespace floatframe::python
