#include <cmath>

#include "floatframe/body/check_invariants.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/formats/body_file/body_members.hpp"
#include "floatframe/math/vector_text.hpp"

namespace floatframe {
namespace {

constexpr double same_number = 1e-6;  // numbers that were printed and read again

class Check {
 public:
  Check(const BodyFile& content, const BodyHeader& header, ArrayReader& arrays, ErrorList& errors,
        const std::string& name)
      : file_(content), header_(header), arrays_(arrays), errors_(errors), name_(name) {}

  /// Conditions on the numbers, and their agreement with the header.
  void run() {
    // For points only if the file states that: see check_invariants.hpp.
    const auto source = file_.part.health.rotary_inertia == false ? InvariantSource::integrals
                                                                  : InvariantSource::rotary;
    for (const InvariantError& f : check_invariants(file_.part.body, source))
      arrays_.error(ErrorCode::wrong_value, f.quantity, "{}", f.sentence);
    if (!errors_.empty()) return;
    const InertiaInvariants& v = file_.part.body.invariants;
    if (const auto& p = file_.part.body.projection) {
      double m = 0.0;
      if (p->six_dof()) {
        for (Eigen::Index r = 0; r < p->M_6.rows(); r += 6)
          for (SparseRows::InnerIterator it(p->M_6, r); it; ++it)
            if (it.col() % 6 == 0) m += it.value();
      } else {
        m = p->M_s.sum();
      }
      if (!(std::abs(m - v.m) <= same_number * v.m))
        arrays_.error(ErrorCode::contradiction,
                      p->six_dof() ? "projection_M_6_data" : "projection_M_s_data",
                      "found {:g} kg in all, expected the mass of member 'm.npy', {:g} kg", m, v.m);
    }
    check_second_order(file_.part.body, arrays_);
    const VecX own = mode_frequencies(file_.part.body);
    for (std::size_t k = 0; k < header_.frequencies.size(); ++k) {
      const double f = own(static_cast<Eigen::Index>(k));
      if (header_.frequencies[k] < 0.0 || !std::isfinite(f)) continue;
      if (std::abs(f - header_.frequencies[k]) <= same_number * std::max(f, header_.frequencies[k]))
        continue;
      error(ErrorCode::contradiction,
            "found {:.6g} Hz for mode {}, but K and the modal mass S11 + S22 + S33 give {:.6g} Hz",
            header_.frequencies[k], k + 1, f);
      break;
    }
    health(v);
    markers_on_the_surface();
  }

 private:
  /// Duplicate data of the same points.
  void markers_on_the_surface() {
    const ReducedPart& part = file_.part;
    if (part.surface_modes.size() == 0) return;
    const double scale = part.surface_modes.cwiseAbs().maxCoeff();
    for (std::size_t k = 0; k < header_.moves_with.size(); ++k)
      for (const std::int64_t point : header_.moves_with[k]) {
        const ModalNode& node = file_.part.body.nodes[k];
        if (point < 0 || point >= part.surface_positions.cols())
          return error(ErrorCode::out_of_range,
                       "found the surface point {} for marker '{}', expected a number from 0 to {}",
                       point, excerpt(node.name), part.surface_positions.cols() - 1);
        const double off = distance_from_rigid(part, node, static_cast<int>(point));
        if (off <= same_number * scale) continue;
        arrays_.error(ErrorCode::contradiction, "marker_X",
                      "marker '{}' moves {:.3g} m per modal amplitude away from point {} of the "
                      "surface, which moves with it (largest mode of the surface: {:.3g} m)",
                      excerpt(node.name), off, point, scale);
        return;
      }
  }

  /// The report was computed from these integrals.
  void health(const InertiaInvariants& v) {
    const HealthReport& h = file_.part.health;
    const MassProperties& said = h.from_invariants;
    if (!(said.mass > 0.0)) return;  // no report
    if (h.modes != v.modes())
      error(ErrorCode::wrong_count, "health: found {} modes, expected the {} of this file", h.modes,
            v.modes());
    if (!(std::abs(v.m - said.mass) <= same_number * said.mass))
      return arrays_.error(ErrorCode::contradiction, "m",
                           "found {:.6g} kg, but the health report gives {:.6g} kg", v.m,
                           said.mass);
    if (h.rotary_inertia) of_the_part(v, h);
    const Mat3 J = v.inertia_about_origin();
    const double length = std::sqrt(J.trace() / v.m);
    const Vec3 c = v.centre_of_mass();
    if (!((c - said.centre).norm() <= same_number * length))
      arrays_.error(ErrorCode::contradiction, "m_u",
                    "found the centre of mass {} m, but the health report gives {} m",
                    vector_text(c), vector_text(said.centre));
    if (!((J - said.J_origin).norm() <= same_number * J.norm()))
      arrays_.error(ErrorCode::contradiction, "P_u",
                    "found moments of inertia {} kg m2 about the origin, but the health report "
                    "gives {} kg m2",
                    vector_text(J.diagonal()), vector_text(said.J_origin.diagonal()));
    for (const InterfaceHealth& interface : h.interfaces)
      for (const ModalNode& node : file_.part.body.nodes)
        if (node.name == interface.name &&
            !((node.p - interface.p).norm() <= same_number * (length + node.p.norm())))
          arrays_.error(ErrorCode::contradiction, "marker_p",
                        "found {} m for '{}', but the health report gives {} m",
                        vector_text(node.p), node.name, vector_text(interface.p));
  }

  /// Files of earlier programs were not checked.
  void of_the_part(const InertiaInvariants& v, const HealthReport& h) {
    const double m = h.from_elements.mass;
    if (m > 0.0 && !(std::abs(v.m - m) <= same_number * m))
      arrays_.error(ErrorCode::contradiction, "m",
                    "found {:.6g} kg, but the health report gives {:.6g} kg of the elements", v.m,
                    m);
    normal_modes(h);
  }

  /// The list of the file is that of the modes that were kept.
  void normal_modes(const HealthReport& h) {
    const VecX& f = file_.part.body.fixed_interface_frequencies;
    std::vector<double> kept;
    for (const ModeHealth& m : h.normal_modes)
      if (m.kept) kept.push_back(m.frequency);
    if (static_cast<Eigen::Index>(kept.size()) != f.size()) return;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const double own = f(static_cast<Eigen::Index>(k));
      if (!std::isfinite(kept[k]) ||
          std::abs(own - kept[k]) <= same_number * std::max(own, kept[k]))
        continue;
      arrays_.error(ErrorCode::contradiction, "frequencies",
                    "found {:.6g} Hz for normal mode {}, but the health report gives {:.6g} Hz",
                    own, k + 1, kept[k]);
      return;
    }
  }

  template <class... Args>
  void error(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
    errors_.add(code, {name_, 0, 0},
                "member 'header.json': " + fmt::format(text, std::forward<Args>(args)...));
  }

  const BodyFile& file_;
  const BodyHeader& header_;
  ArrayReader& arrays_;
  ErrorList& errors_;
  const std::string& name_;
};

}  // namespace

void check_body_numbers(const BodyFile& content, const BodyHeader& header, ArrayReader& arrays,
                        ErrorList& errors, const std::string& name) {
  Check(content, header, arrays, errors, name).run();
}

}  // namespace floatframe
