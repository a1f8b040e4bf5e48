#include "support/random_force.hpp"

#include <algorithm>
#include <limits>

#include "floatframe/model/element_kind.hpp"

namespace floatframe::test {
namespace {

/// The tables of tyres depend on each other: those of a small one.
void give_tables(TmeasyTyre& t, double stiffness) {
  t.nominal_load = 10.0;
  t.max_load = std::nullopt;
  t.stiffness = Eigen::RowVector2d(stiffness, 1.1 * stiffness);
  t.longitudinal.resize(2, 5);
  t.longitudinal << 180.0, 11.0, 0.14, 8.0, 0.67, 380.0, 21.0, 0.14, 15.0, 0.67;
  t.lateral = t.longitudinal;
  t.trail.resize(2, 3);
  t.trail << 0.18, 0.16, 0.96, 0.19, 0.2, 1.07;
  t.longitudinal_stiffness = t.lateral_stiffness = 20.0 * stiffness;
}
void give_tables(CalspanTyre& t, double stiffness) {
  t.stiffness = stiffness;
  t.cornering = Eigen::RowVector3d(10.0, 14.0, 60.0);
  t.camber = Eigen::RowVector2d(2.0, 90.0);
  t.friction = Eigen::RowVector3d(-4e-3, 1.2, 1e-6);
}
void give_tables(MagicFormulaTyre& t, double) {
  t.file = std::string(FLOATFRAME_TEST_DATA) + "/tyres/mf/a_205_60R15_mf61.tir";
}
void give_tables(RollingTyre&, double) {}

}  // namespace

ElementDescription random_force(ElementType type, const RandomForceEnds& ends,
                                ExampleNumbers& numbers) {
  ElementDescription f;
  f.name = std::string("random_") + element_type_name(type);
  f.kind = element_kind(type).blank();
  int places = 0;
  double least = std::numeric_limits<double>::infinity();  // of the numbers that must be given
  const auto value = [&](const ElementKey& key) -> std::optional<KeyValue> {
    using K = KeyKind;
    const double size = key.axis == ElementAxis::about ? ends.length * ends.length : 1.0;
    switch (key.kind) {
      case K::place:
        return places++ % 2 == 0 ? ends.a : ends.b;
      case K::own_place:
        return ends.b;
      case K::joint:
        if (!key.required) return std::nullopt;  // instead of places
        return ends.joint;
      case K::own_coordinate:  // the only one
        return std::nullopt;
      case K::road:
        return ends.road;
      case K::direction:
      case K::vector:
        return numbers.direction();
      case K::number: {
        const double low = std::max(key.rule.low, -1.0);
        const double x = std::min(low + numbers(0.3, 1.0), key.rule.high);
        // Some are limited by those that must be given.
        if (key.required) least = std::min(least, x);
        return key.required || !(least > low) ? x : std::min(x, least);
      }
      case K::word:
        return static_cast<int>(numbers(0.0, static_cast<double>(key.words.size()) - 1e-9));
      case K::flag:
        return numbers(0.0, 1.0) < 0.5;
      case K::spring: {
        const double k = size * ends.stiffness * numbers(0.5, 1.5);
        return PiecewisePolynomial::polynomial({0.02 * k, k, 0.3 * k, 0.4 * k});
      }
      case K::damper: {
        const double c = size * ends.damping * numbers(0.5, 1.5);
        return PiecewisePolynomial::polynomial({0.0, c, 0.1 * c, 0.05 * c});
      }
      case K::formula:
        return formula("t");
      case K::load: {
        SignalDescription s;
        s.pieces = PiecewisePolynomial::polynomial({size * numbers(-3.0, 3.0), size});
        return s;
      }
      case K::stiffness_matrix:
      case K::damping_matrix: {
        // Symmetric, with cross terms; nothing about the axis of the shaft.
        const bool stiff = key.kind == K::stiffness_matrix;
        const double k = stiff ? ends.stiffness : ends.damping, l = ends.length;
        const double sizes[] = {1.0, 1.0, 1.0, l, l, stiff ? 0.0 : l};
        MatX M(6, 6);
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j <= i; ++j) {
            const double x = i == j ? numbers(0.5, 1.5) : numbers(-0.08, 0.08);
            M(i, j) = M(j, i) = k * sizes[i] * sizes[j] * x;
          }
        return M;
      }
      case K::table: {
        MatX rows(2, std::ssize(key.words));
        for (Eigen::Index i = 0; i < rows.size(); ++i) rows(i) = numbers(20.0, 60.0);
        return rows;
      }
      case K::function: {
        const double k = size * ends.stiffness * numbers(0.5, 1.5), c = size * ends.damping;
        return ForceFunction([=](double x, double v, double) {
          return ForceLawValue(k * (0.02 + x + 0.4 * x * x * x) + c * v, k * (1.0 + 1.2 * x * x),
                               c);
        });
      }
      case K::bump_stop:
      case K::rebound_stop:  // they have kinks
      case K::target:
      case K::target_rate:  // those of motors
      case K::speed_table:
      case K::motion:  // what couplings hold is added by `with_coupling`
      case K::terms:
      case K::coordinate:
      case K::numbers:
      case K::points:
      case K::shape:
      case K::signals:  // those of controllers
      case K::matrix:
      case K::names:
      case K::linear_file:
      case K::file:
        return std::nullopt;
    }
    return std::nullopt;
  };
  for (const ElementKey& key : element_keys(type))
    if (const auto x = value(key)) set_key_value(f, key, *x);
  if (auto* stop = std::get_if<JointStop>(&f.kind); stop && *stop->upper < *stop->lower)
    std::swap(stop->lower, stop->upper);
  if (auto* journal = std::get_if<JournalBearing>(&f.kind)) journal->kinetic = journal->friction;
  std::visit(
      [&](auto& keys) {
        if constexpr (std::is_base_of_v<RollingTyre, std::remove_cvref_t<decltype(keys)>>) {
          keys.axis = Vec3::UnitY() + 0.3 * numbers.vector();  // it does not lie
          keys.contact = TyreContact::patch;                   // of which some numbers are
          give_tables(keys, ends.stiffness);
        }
      },
      f.kind);
  if (auto* friction = std::get_if<BristleFriction>(&f.kind)) {  // random joints repeat each other
    friction->reaction = false;
    friction->bearing_radius = friction->axial_radius = friction->bearing_length = std::nullopt;
  }
  return f;
}

}  // namespace floatframe::test
