// Membranes: patch tests, closed forms in their plane, laminates, stress of a load across them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "floatframe/fe/flat_nodes.hpp"
#include "floatframe/fe/stress_stiffness.hpp"
#include "support/error_of.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

constexpr FeElementType membranes[] = {FeElementType::membrane3,  FeElementType::membrane4,
                                       FeElementType::membrane4s, FeElementType::membrane6,
                                       FeElementType::membrane8,  FeElementType::membrane8r};
constexpr double E_mod = 7e10, nu = 0.3, t = 0.002, rho = 2700.0;

/// A mesh of n x n cells over [0, a] x [0, b], inner corners moved; nodes on edges in their middle.
FeModel membrane_sheet(FeElementType type, int n, double a, double b, double moved, const Mat3& R) {
  FeModel model;
  model.materials = {{E_mod, nu, rho}};
  model.shells = {{.thickness = t}};
  Random random(4);
  const bool middles = element_kernel(type).nodes > 4;
  const int m = middles ? 2 * n : n, step = middles ? 2 : 1;
  const auto at = [&](int i, int j) { return j * (m + 1) + i; };
  std::vector<Vec3> p(static_cast<std::size_t>((m + 1) * (m + 1)));
  const auto place = [&](int i, int j) -> Vec3& { return p[static_cast<std::size_t>(at(i, j))]; };
  for (int j = 0; j <= m; j += step)
    for (int i = 0; i <= m; i += step) {
      place(i, j) = Vec3(a * i / m, b * j / m, 0);
      if (i > 0 && j > 0 && i < m && j < m)
        place(i, j) += Vec3(moved * random(), moved * random(), 0);
    }
  if (middles)
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i <= m; ++i) {
        if (i % 2 == 1 && j % 2 == 0) place(i, j) = .5 * (place(i - 1, j) + place(i + 1, j));
        if (i % 2 == 0 && j % 2 == 1) place(i, j) = .5 * (place(i, j - 1) + place(i, j + 1));
        if (i % 2 == 1 && j % 2 == 1)
          place(i, j) = .5 * (place(i - 1, j - 1) + place(i + 1, j + 1));
      }
  for (const Vec3& x : p) model.positions.emplace_back(R * x);
  for (int j = 0; j < m; j += step)
    for (int i = 0; i < m; i += step) {
      const int s = step, h = 1;
      FeElement e;
      e.type = type;
      const auto add = [&](std::initializer_list<int> nodes) {
        std::copy(nodes.begin(), nodes.end(), e.nodes.begin());
        model.elements.push_back(e);
      };
      const int c[4] = {at(i, j), at(i + s, j), at(i + s, j + s), at(i, j + s)};
      const int q[4] = {at(i + h, j), at(i + s, j + h), at(i + h, j + s), at(i, j + h)};
      if (type == FeElementType::membrane3) {
        add({c[0], c[1], c[2]});
        add({c[0], c[2], c[3]});
      } else if (type == FeElementType::membrane6) {
        add({c[0], c[1], c[2], q[0], q[1], at(i + h, j + h)});
        add({c[0], c[2], c[3], at(i + h, j + h), q[2], q[3]});
      } else {
        add({c[0], c[1], c[2], c[3], q[0], q[1], q[2], q[3]});
      }
    }
  return model;
}

/// Displacements of all nodes by a function of the place in the sheet.
template <class Field>
VecX membrane_field(const FeModel& model, const FeSystem& system, const Mat3& R, const Field& u) {
  VecX out = VecX::Zero(system.size());
  for (int k = 0; k < model.nodes(); ++k)
    if (system.first[k] >= 0)
      out.segment<3>(system.first[k]) = R * u(Vec3(R.transpose() * model.positions[k]));
  return out;
}

Mat3 plane_matrix(double young, double poisson) {
  Mat3 Q;
  Q << 1, poisson, 0, poisson, 1, 0, 0, 0, .5 * (1 - poisson);
  return young / (1 - poisson * poisson) * Q;
}

// Constant strain on an irregular mesh: no forces on inner nodes, energy and stress exact.
TEST(Membranes, PatchTest) {
  Random random(7);
  const double a = 1.2, b = .9;
  for (const FeElementType type : membranes) {
    SCOPED_TRACE(fe_element_name(type));
    const Mat3 R = random.rotation();
    const FeModel model = membrane_sheet(type, 3, a, b, .08, R);
    validate(model);
    const FeSystem system = assemble(model);
    const Vec3 strain(1e-3, -4e-4, 7e-4);
    const VecX u = membrane_field(model, system, R, [&](const Vec3& x) {
      return Vec3(strain(0) * x(0) + .2 * strain(2) * x(1),
                  strain(1) * x(1) + .8 * strain(2) * x(0), 0);
    });
    const VecX f = system.K * u;
    const double size = f.cwiseAbs().maxCoeff();
    for (int k = 0; k < model.nodes(); ++k) {
      const Vec3 x = R.transpose() * model.positions[k];
      const bool inside = x(0) > 1e-9 && x(1) > 1e-9 && x(0) < a - 1e-9 && x(1) < b - 1e-9;
      if (!inside || system.first[k] < 0) continue;
      EXPECT_LT(f.segment<3>(system.first[k]).norm(), 1e-12 * size) << k;
    }
    const Vec3 stress = plane_matrix(E_mod, nu) * strain;
    EXPECT_NEAR(u.dot(f) / (strain.dot(stress) * a * b * t), 1.0, 1e-12);
    Mat3 S;
    S << stress(0), stress(2), 0, stress(2), stress(1), 0, 0, 0, 0;
    S = (R * S * R.transpose()).eval();
    Vec6 expected;
    expected << S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(1, 2), S(2, 0);
    for (const FeElement& e : model.elements) {
      const ElementKernel& kernel = element_kernel(e.type);
      MatX B;
      kernel.layer_stresses(gather(model, e), B);
      VecX q(3 * kernel.nodes);
      for (int k = 0; k < kernel.nodes; ++k)
        q.segment<3>(3 * k) = u.segment<3>(system.first[e.nodes[k]]);
      for (int k = 0; k < 2 * kernel.nodes; ++k)
        EXPECT_LT((B.middleRows<6>(6 * k) * q - expected).norm(), 1e-11 * expected.norm());
    }
    VecX z = membrane_field(model, system, R, [](const Vec3&) { return Vec3::UnitZ(); });
    EXPECT_NEAR(z.dot(system.M * z), rho * t * a * b, 1e-12);
    // Nothing resists motions across it.
    z = membrane_field(model, system, R, [&](const Vec3&) { return Vec3(0, 0, random()); });
    EXPECT_LT((system.K * z).norm(), 1e-12 * size / 1e-3);
  }
}

// Bent in its plane, a rectangle: u = x y, v = -x^2/2 - nu y^2/2 has the energy of a beam,
// E t h^3/12 L/2 twice. Elements of 8 nodes are exact; with shear from the middle a rectangle of 4
// nodes has 1/(1 - nu^2), as its displacement v cannot follow; with shear at 2 x 2 points besides
// (1 - nu)/2 (L/h)^2/(1 - nu^2).
TEST(Membranes, BentInTheirPlane) {
  const double L = .3, h = .1, beam = E_mod * t * h * h * h / 12 * L;
  const auto energy = [&](FeElementType type) {
    FeModel model = membrane_sheet(type, 1, L, h, 0.0, Mat3::Identity());
    const FeSystem system = assemble(model);
    const VecX u = membrane_field(model, system, Mat3::Identity(), [&](const Vec3& p) {
      const double x = p(0) - .5 * L, y = p(1) - .5 * h;
      return Vec3(x * y, -.5 * x * x - .5 * nu * y * y, 0);
    });
    return u.dot(system.K * u) / beam;
  };
  EXPECT_NEAR(energy(FeElementType::membrane8), 1.0, 1e-12);
  EXPECT_NEAR(energy(FeElementType::membrane6), 1.0, 1e-12);
  EXPECT_NEAR(energy(FeElementType::membrane8r), 1.0, 1e-12);
  EXPECT_NEAR(energy(FeElementType::membrane4s), 1 / (1 - nu * nu), 1e-12);
  EXPECT_NEAR(energy(FeElementType::membrane4),
              (1 + .5 * (1 - nu) * L * L / (h * h)) / (1 - nu * nu), 1e-12);
}

// A ply at an angle: N = A e with A turned as a tensor, on a sheet that lies anyhow.
TEST(Membranes, PliesTurnWithTheirAngle) {
  const double angle = 35 * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const Material ply = anisotropic_material(
      lamina_elasticity({.E1 = 1.4e11, .E2 = 1e10, .nu12 = .3, .G12 = 5e9, .G13 = 5e9, .G23 = 5e9}),
      true, 1600.0);
  for (const FeElementType type : membranes) {
    SCOPED_TRACE(fe_element_name(type));
    FeModel model = membrane_sheet(type, 2, 1.0, 1.0, .05, Mat3::Identity());
    model.materials = {ply};
    model.shells = {{.thickness = t, .plies = {{0, .5 * t, angle}, {0, .5 * t, angle}}}};
    model.orientations = {{}};
    for (FeElement& e : model.elements) e.orientation = 0;
    validate(model);
    const FeSystem system = assemble(model);
    // Stretched along the fibres, with no other strain: E1/(1 - nu12 nu21) t.
    const VecX u = membrane_field(model, system, Mat3::Identity(), [&](const Vec3& x) {
      return Vec3((c * x(0) + s * x(1)) * Vec3(c, s, 0));
    });
    EXPECT_NEAR(u.dot(system.K * u) / (1.4e11 / (1 - .09 * 1e10 / 1.4e11) * t), 1.0, 1e-12);
  }
}

// A sheet under tension N resists motions across it: energy N/2 (dw/dx)^2 of a slope.
TEST(Membranes, TensionStiffensThemAcross) {
  const double a = 1.2, b = .9, e = 1e-3;
  for (const FeElementType type : membranes) {
    SCOPED_TRACE(fe_element_name(type));
    const FeModel model = membrane_sheet(type, 2, a, b, .05, Mat3::Identity());
    NodalShapes load, mode;
    load.U = load.Theta = mode.U = mode.Theta = MatX::Zero(3 * model.nodes(), 1);
    for (int k = 0; k < model.nodes(); ++k) {
      const Vec3& x = model.positions[k];
      load.U.block<3, 1>(3 * k, 0) = Vec3(e * x(0), -nu * e * x(1), 0);
      mode.U(3 * k + 2, 0) = x(0);
    }
    const MatX K = stress_stiffness(model, mode, load);
    EXPECT_NEAR(K(0, 0) / (E_mod * e * t * a * b), 1.0, 1e-12);
  }
}

TEST(Membranes, ErrorsNameTheElement) {
  const auto error = [](FeElementType type, const std::function<void(FeModel&)>& change) {
    FeModel model = membrane_sheet(type, 1, 1.0, 1.0, 0.0, Mat3::Identity());
    model.elements.resize(1);
    change(model);
    return error_of([&] { validate(model); });
  };
  EXPECT_EQ(error(FeElementType::membrane4, [](FeModel& m) { m.shells[0].offset = .1; }),
            "geometry");
  EXPECT_EQ(error(FeElementType::membrane4s, [](FeModel& m) { m.shells[0].thickness = 0; }),
            "geometry");
  EXPECT_EQ(error(FeElementType::membrane4,
                  [](FeModel& m) { std::swap(m.elements[0].nodes[1], m.elements[0].nodes[2]); }),
            "geometry");
  EXPECT_EQ(error(FeElementType::membrane8,
                  [](FeModel& m) { std::swap(m.elements[0].nodes[5], m.elements[0].nodes[7]); }),
            "geometry");
  EXPECT_EQ(
      error(FeElementType::membrane3, [](FeModel& m) { m.positions[3] = m.positions[0] / 2; }),
      "geometry");
}

TEST(Membranes, NodesThatNothingHoldsAcross) {
  FeModel model = membrane_sheet(FeElementType::membrane4, 2, 1.0, 1.0, 0.0, Mat3::Identity());
  EXPECT_EQ(flat_nodes(model),
            "the part is a mechanism: 9 nodes are on membranes or shear panels of one plane and on "
            "nothing else, which do not resist motions across it, first node 0; other programs "
            "hold such nodes in space (AUTOSPC), which a part that moves cannot be: give them "
            "bending stiffness");
  // A roof has no such nodes along its ridge.
  for (Vec3& p : model.positions) p(2) = std::abs(p(0) - .5);
  EXPECT_TRUE(contains(flat_nodes(model), "6 nodes"));
  FeElement rod;
  rod.type = FeElementType::rod2;
  rod.nodes = {0, 9};
  model.positions.emplace_back(0, 0, -1);
  model.sections = {{}};
  model.elements.push_back(rod);
  EXPECT_TRUE(contains(flat_nodes(model), "5 nodes"));
}

}  // namespace
}  // namespace floatframe::test
