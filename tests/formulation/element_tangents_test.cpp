// The tangent of a whole system with every kind of force and every joint, against differences of
// its residual. The formulations leave terms of the stiffness out (theory, known limits); what a
// step of h sees of them is h^2/4 of their size, while masses and dampers must be right to the
// last: halving h must quarter the difference.
#include <gtest/gtest.h>

#include "floatframe/core/enum_index.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/piecewise_build.hpp"
#include "floatframe/model/element_kind.hpp"
#include "support/element_motion.hpp"
#include "support/random_model.hpp"

namespace floatframe::test {
namespace {

/// A chain with every joint, twice closed, and one element of every kind and regime of force
/// between its bodies or on one of them.
Model everything(unsigned seed) {
  RandomSystem s(seed);
  std::string previous = ground_name;
  std::vector<std::string> names;
  for (const JointType type : all_joint_types) {
    const std::string name = std::string("body_") + joint_type_name(type);
    s.add_body(name, joint_velocities(type) % 2 == 0 ? 2 : 0);
    s.add_joint(joint_type_name(type), type, previous, 1, name, 0);
    names.push_back(name);
    previous = joint_is_free(type) ? std::string(ground_name) : name;
  }
  s.add_joint("cut_ball", JointType::spherical, ground_name, 0, "body_spherical", 3).cut = true;
  s.add_joint("cut_universal", JointType::universal, "body_free", 2, "body_prismatic", 3).cut =
      true;
  Model model = build_model(s.d);

  const auto marker = [&](std::size_t body) {
    Marker m;
    m.body = static_cast<int>(body);
    if (model.bodies[body].modes() > 0) {
      m.node = 4;
      m.rotates = true;
    } else {
      m.X_NM.p = s.random.vec3(0.4);
    }
    model.markers.push_back(m);
    return static_cast<int>(model.markers.size()) - 1;
  };
  ExampleNumbers numbers(seed);
  for (const ElementType type : types_of(ElementList::forces)) {
    const ElementKind& kind = element_kind(type);
    for (std::size_t regime = 0; regime < kind.regimes.size(); ++regime) {
      ElementExample x = element_example(type, regime, numbers);
      Element e = x.element;
      e.name = std::string(element_type_name(type)) + "_" + kind.regimes[regime].name;
      const std::size_t body = model.elements.size() % names.size();
      if (kind.axis == ElementAxis::coordinate && !(kind.along_line && e.coordinates.empty())) {
        // On a joint of its kind, as the builder would put it.
        for (int k = 0; k < std::ssize(model.joints); ++k) {
          const Joint& j = model.joints[k];
          if (j.type != (e.rotational ? JointType::revolute : JointType::prismatic)) continue;
          e.coordinates = {{k, 0, 0, e.acts && e.rotational}};
          e.markers = {j.frame_F, j.frame_M};
        }
      } else {
        const std::size_t ports = x.markers.size();
        for (std::size_t i = 0; i < ports; ++i)
          e.markers.push_back(marker((body + 2 * (ports - 1 - i)) % names.size()));
      }
      if (e.road >= 0) {
        e.road = static_cast<int>(model.roads.size());
        Road road = x.model.roads.at(0);
        // In contact wherever the body is.
        road.pieces = road.pieces + PiecewisePolynomial::polynomial({20.0});
        model.roads.push_back(std::move(road));
      }
      // There are no inputs.
      for (Signal& signal : e.signals) {
        signal.input = signal.link = -1;
        signal.local = nullptr;
      }
      e.switched = false;
      model.elements.push_back(std::move(e));
    }
  }
  return model;
}

/// Drops the elements whose rows are not their whole damping here (tyres on slopes, all that roll).
Model with_exact_dampers(const Model& model, const VecX& q) {
  RelativeFormulation f(model, InertiaMethod::preprocessing);
  evaluate_at(f, 0.3, q, VecX::Zero(f.velocities()));
  f.forces();
  Model kept = model;
  kept.elements.clear();
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& element = model.elements[k];
    const EffortTangent t = exact_tangent(f.ports(k));
    const MatX C = 0.5 * (t.C + t.C.transpose()) - tangent_of_rows(f.effort(static_cast<int>(k))).C;
    if (C.cwiseAbs().maxCoeff() < 1e-9) kept.elements.push_back(element);
  }
  std::vector<int> of_type(std::size(element_types), 0);
  for (const Element& element : kept.elements) ++of_type[index_of(element.type)];
  for (const ElementType type : types_of(ElementList::forces))
    if (type == ElementType::tyre || energy_category(type) != EnergyCategory::tyres) {
      EXPECT_GT(of_type[index_of(type)], 0) << element_type_name(type);
    }
  return kept;
}

/// The factorised T against M + h/2 C + h^2/4 K, all by differences, in the directions that leave
/// the constraints of the formulation alone (`directions`).
template <class F>
double difference(F& f, const VecX& q, const VecX& v, const MatX& directions, double h) {
  const int n = f.velocities();
  const VecX zero = VecX::Zero(n), lambda = VecX::Zero(f.constraints());
  VecX plus(n), minus(n), q1 = q;
  const auto residual = [&](const VecX& at, const VecX& rate, VecX& out) {
    evaluate_at(f, 0.3, at, rate);
    f.dynamics();
    f.residual(zero, lambda, 0.0, out);
  };
  const Eigen::Index m = directions.cols();
  MatX K(n, m), C(n, m), M(n, m);
  constexpr double d = 1e-6;
  for (Eigen::Index j = 0; j < m; ++j) {
    const VecX x = directions.col(j);
    f.retract(q, d * x, q1);
    residual(q1, v, plus);
    f.retract(q, -d * x, q1);
    residual(q1, v, minus);
    K.col(j) = (plus - minus) / (2 * d);
    residual(q, v + d * x, plus);
    residual(q, v - d * x, minus);
    C.col(j) = (plus - minus) / (2 * d);
  }
  residual(q, v, minus);
  for (Eigen::Index j = 0; j < m; ++j) {
    f.residual(directions.col(j), lambda, 0.0, plus);
    M.col(j) = plus - minus;
  }
  residual(q, v, minus);
  EXPECT_EQ(f.factorize(1.0, 0.5 * h, 0.25 * h * h, 4.0 / (h * h)), -1);
  MatX inverse(n, n);
  for (int j = 0; j < n; ++j) {
    VecX x = VecX::Unit(n, j);
    f.solve(x);
    inverse.col(j) = x;
  }
  const MatX J = f.constraint_jacobian(), Z = free_directions(f);
  const MatX T =
      Z * lu_solve(MatX(Z.transpose() * inverse * Z), MatX::Identity(Z.cols(), Z.cols())) *
          Z.transpose() -
      J.transpose() * J;
  const MatX exact = directions.transpose() * (M + 0.5 * h * C + 0.25 * h * h * K);
  const double mass = largest(directions.transpose() * M);
  return largest(directions.transpose() * T * directions - 0.5 * (exact + exact.transpose())) /
         mass;
}

// At rest no gyroscopic terms disturb the damping.
TEST(SystemTangent, MassAndDampingAreExactAndStiffnessFollowsTheStep) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Model whole = everything(seed);
    VecX q, v;
    {
      RelativeFormulation f(whole, InertiaMethod::preprocessing);
      Random random(seed);
      random_configuration(f, random, q, v);
    }
    const Model model = with_exact_dampers(whole, q);
    RelativeFormulation relative(model, InertiaMethod::preprocessing);
    AbsoluteFormulation absolute(model, InertiaMethod::preprocessing);
    v.setZero();
    VecX qa, va;
    absolute.start_from(relative, q, v, qa, va);
    const auto check = [&](const char* name, auto& f, const VecX& at, const VecX& rest,
                           const MatX& directions) {
      const double coarse = difference(f, at, rest, directions, 2e-3);
      const double fine = difference(f, at, rest, directions, 1e-3);
      std::printf("[ figure ] tangent_left_out_%s_%u %.1e %.1e\n", name, seed, coarse, fine);
      EXPECT_LT(fine, 1e-3) << seed;
      EXPECT_LT(fine, 0.26 * coarse) << seed;
    };
    check("relative", relative, q, v, MatX::Identity(v.size(), v.size()));
    check("absolute", absolute, qa, va, velocity_map(relative, absolute, q));
  }
}

}  // namespace
}  // namespace floatframe::test
