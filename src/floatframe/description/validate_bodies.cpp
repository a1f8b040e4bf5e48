// Bodies: position, mass properties, data of reduced bodies.
#include <cmath>

#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/description/validate.hpp"

namespace floatframe::validation {

void rigid(const RigidDescription& r, const Entity& body) {
  body.number("rigid.mass", r.mass, rules::mass);
  body.vector("rigid.centre_of_mass", r.p_BC, "m");
  if (!r.J_C.allFinite()) {
    body.error(ErrorCode::not_finite, "rigid.inertia",
               "found numbers that are not finite, expected an inertia tensor [kg m2]");
    return;
  }
  const double size = r.J_C.cwiseAbs().maxCoeff();
  if ((r.J_C - r.J_C.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size)
    body.error(ErrorCode::contradiction, "rigid.inertia",
               "found a tensor that is not symmetric, expected equal products of inertia on both "
               "sides of the diagonal [kg m2]");
  else
    body.complain(ErrorCode::out_of_range, "rigid.inertia", sentences::inertia(r.J_C));
}

namespace {

bool is_mirror(const Mat3& P) {
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      if (i == j ? std::abs(P(i, j)) != 1.0 : P(i, j) != 0.0) return false;
  return true;
}

/// Sizes and finiteness of the arrays of a reduced body.
class Arrays {
 public:
  Arrays(const FlexibleBody& f, const Entity& body) : f_(f), body_(body) {}

  void check() {
    const InertiaInvariants& v = f_.invariants;
    const Eigen::Index n = v.S.cols();
    size("invariants.S", v.S, 3, n);
    values("invariants.m_u", v.m_u);
    values("invariants.P_u", v.P_u);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string k = "[" + std::to_string(i) + "]";
      size("invariants.Si" + k, v.Si[i], 3, n);
      for (std::size_t j = 0; j < 3; ++j)
        size("invariants.Sij" + k + "[" + std::to_string(j) + "]", v.Sij[i][j], n, n);
    }
    if (!(v.m >= 0.0) || !std::isfinite(v.m))
      body_.complain(ErrorCode::out_of_range, "invariants.m", rules::mass.complaint(v.m));
    size("K", f_.K, n, n);
    size("D", f_.D, n, n);
    symmetric("K", f_.K);
    symmetric("D", f_.D);
    for (std::size_t k = 0; k < f_.nodes.size(); ++k) {
      const ModalNode& node = f_.nodes[k];
      const auto fits = [&](const Mat3X& X) { return X.cols() == n && X.allFinite(); };
      if (node.p.allFinite() && fits(node.X) && fits(node.X_theta)) continue;
      const std::string path = "nodes[" + std::to_string(k) + "].";
      values(path + "p", node.p);
      size(path + "X", node.X, 3, n);
      size(path + "X_theta", node.X_theta, 3, n);
    }
    if (f_.projection) projection(*f_.projection, n);
    if (f_.fixed_interface_frequencies.size() > 0)
      values("fixed_interface_frequencies", f_.fixed_interface_frequencies);
  }

 private:
  template <class Matrix>
  void values(const std::string& what, const Matrix& m) {
    if (!m.allFinite())
      body_.error(ErrorCode::not_finite, what,
                  "found numbers that are not finite, expected finite ones");
  }
  template <class Matrix>
  void size(const std::string& what, const Matrix& m, Eigen::Index rows, Eigen::Index columns) {
    if (m.rows() != rows || m.cols() != columns)
      body_.error(ErrorCode::wrong_count, what,
                  "found " + std::to_string(m.rows()) + " x " + std::to_string(m.cols()) +
                      " numbers, expected " + std::to_string(rows) + " x " +
                      std::to_string(columns) + " for " + std::to_string(f_.invariants.S.cols()) +
                      " modes");
    else
      values(what, m);
  }
  void symmetric(const std::string& what, const MatX& m) {
    if (m.rows() != m.cols() || m.size() == 0 || !m.allFinite()) return;
    if ((m - m.transpose()).cwiseAbs().maxCoeff() > 1e-6 * m.cwiseAbs().maxCoeff())
      body_.error(ErrorCode::contradiction, what,
                  "found a matrix that is not symmetric, expected a symmetric one");
  }
  template <class Sparse>
  void sparse(const std::string& what, const Sparse& m, Eigen::Index n) {
    if (m.rows() != n || m.cols() != n) {
      body_.error(ErrorCode::wrong_count, what,
                  "found " + std::to_string(m.rows()) + " x " + std::to_string(m.cols()) +
                      " numbers, expected " + std::to_string(n) + " x " + std::to_string(n));
      return;
    }
    for (Eigen::Index k = 0; k < m.outerSize(); ++k)
      for (typename Sparse::InnerIterator it(m, k); it; ++it)
        if (!std::isfinite(it.value())) {
          body_.error(ErrorCode::not_finite, what,
                      "found numbers that are not finite, expected finite ones");
          return;
        }
  }
  void projection(const ProjectionData& p, Eigen::Index n) {
    const Eigen::Index nodes = p.p.cols();
    values("projection.p", p.p);
    size("projection.X", p.X, 3 * nodes, n);
    if (p.six_dof()) {
      size("projection.X_theta", p.X_theta, 3 * nodes, n);
      sparse("projection.M_6", p.M_6, 6 * nodes);
    } else {
      sparse("projection.M_s", p.M_s, nodes);
    }
  }

  const FlexibleBody& f_;
  const Entity& body_;
};

}  // namespace

void flexible(const FlexibleBody& f, const Entity& body) {
  body.word("flexible.mass_model", f.mass_model, rules::mass_models);
  const Entity part{body.errors, body.origin, body.path + ".flexible"};
  Arrays(f, part).check();
}

void bodies(const ModelDescription& d, ErrorList& errors) {
  if (d.bodies.empty())
    errors.add(ErrorCode::missing, {}, "bodies: found none, expected at least one body");
  std::set<std::string> taken;
  for (const BodyDescription& b : d.bodies) {
    const Entity body{errors, b.origin, "bodies." + b.name};
    name("bodies", b.name, taken, body);
    body.vector("position", b.X_WB.p, "m");
    body.rotation("orientation", b.X_WB.R);
    if (!is_mirror(b.mirror))
      body.error(ErrorCode::wrong_value, "mirror",
                 "found a matrix that is not diagonal with 1 and -1, expected a reflection at "
                 "planes normal to the axes");
    body.vector("template.position", b.X_WT.p, "m");
    body.rotation("template.orientation", b.X_WT.R);
    if (const auto* r = std::get_if<RigidDescription>(&b.kind)) rigid(*r, body);
    if (const auto* f = std::get_if<FlexibleDescription>(&b.kind)) flexible(*f, body);
    if (const auto* f = std::get_if<FlexibleBody>(&b.kind)) flexible(*f, body);
  }
}

void amplitudes(const ModelDescription& d, const Names& names, ErrorList& errors) {
  const auto check = [&](const char* key, const std::map<std::string, VecX>& given) {
    for (const auto& [body_name, values] : given) {
      const Origin none;
      const auto k = names.bodies.find(body_name);
      const Entity entity{errors, k ? d.bodies[*k].origin : none, std::string("initial.") + key};
      if (!entity.reference(body_name, "body", body_name, names.bodies)) continue;
      const BodyDescription& b = d.bodies[*k];
      if (b.rigid || std::holds_alternative<RigidDescription>(b.kind)) {
        entity.error(ErrorCode::wrong_value, body_name,
                     sentences::rigid_body_has_no_modes(b.rigid));
        continue;
      }
      for (Eigen::Index i = 0; i < values.size(); ++i)
        entity.number(body_name + "[" + std::to_string(i + 1) + "]", values[i], any_number(""));
    }
  };
  check("amplitudes", d.amplitudes);
  check("amplitude_rates", d.amplitude_rates);
}

}  // namespace floatframe::validation
