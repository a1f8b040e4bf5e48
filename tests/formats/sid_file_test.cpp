// SID_FEM: what is written comes back; the blocks are those of the kinetic energy and of the
// velocity-dependent forces computed by the inertia room; the classical dialect; errors.
#include "floatframe/formats/sid/sid_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/formats/sid/sid_content.hpp"
#include "floatframe/inertia/preprocessing.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/error_of.hpp"
#include "support/iltis_parts.hpp"
#include "support/point_masses.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

FlexibleBody body_of(const PointMasses& points, int nm) {
  FlexibleBody body;
  body.invariants = integrals_of(points, nm);
  for (std::size_t i = 0; i < points.m.size(); ++i)
    body.nodes.push_back({fmt::format("P{}", i), points.p[i], points.X[i], Mat3X::Zero(3, nm)});
  body.K = MatX::Zero(nm, nm);
  body.D = MatX::Zero(nm, nm);
  return body;
}

FlexibleBody random_body(unsigned seed, int nm) {
  Random random(seed);
  FlexibleBody body = body_of(random_point_masses(random, 12, nm), nm);
  const MatX A = random.matrix(nm, nm), B = random.matrix(nm, nm);
  body.K = 1e6 * A * A.transpose();
  body.D = B * B.transpose();
  for (ModalNode& node : body.nodes) node.X_theta = random.matrix(3, nm);
  return body;
}

FlexibleBody beam_body() {
  ReductionOptions options = a_arm_options();
  options.damping = 0.02;
  return reduce(build_bar_frame(a_arm_frame(10)), options);
}

std::vector<FlexibleBody> bodies() {
  std::vector<FlexibleBody> list;
  for (const int nm : {1, 2, 7}) list.push_back(random_body(10u + static_cast<unsigned>(nm), nm));
  list.push_back(beam_body());
  list.push_back(random_body(3, 0));
  return list;
}

MatX mass_matrix(const FlexibleBody& body, const VecX& y) {
  const int nm = body.modes();
  const PreprocessingData data(body.invariants);
  PreprocessingWorkspace work(nm);
  MatX M(6 + nm, 6 + nm);
  VecX Qv(6 + nm);
  const VecX ydot = VecX::Zero(nm);
  relative_preprocessing(data, Vec3::Zero(), Mat3::Identity(), Vec3::Zero(), y.data(), ydot.data(),
                         work, M, Qv);
  return M;
}

/// Exact: the mass matrix is of second order in the amplitudes.
MatX mass_derivative(const FlexibleBody& body, int k) {
  const VecX e = VecX::Unit(body.modes(), k);
  return 0.5 * (mass_matrix(body, e) - mass_matrix(body, -e));
}

void expect_same_mass(const FlexibleBody& a, const FlexibleBody& b, double limit) {
  ASSERT_EQ(a.modes(), b.modes());
  const VecX zero = VecX::Zero(a.modes());
  EXPECT_LT(relative_error(mass_matrix(b, zero), mass_matrix(a, zero)), limit);
  for (int k = 0; k < a.modes(); ++k) {
    EXPECT_LT(relative_error(mass_derivative(b, k), mass_derivative(a, k)), limit) << "mode " << k;
  }
}

/// The classical file: Oe of order 0.
std::string without_second_order(const std::string& text) {
  std::istringstream in(text);
  std::string out, line;
  bool inside = false;
  while (std::getline(in, line)) {
    const std::size_t first = line.find_first_not_of(' ');
    const std::string word = first == std::string::npos ? "" : line.substr(first);
    if (word == "Oe") inside = true;
    if (word == "end Oe") inside = false;
    if (inside && word.starts_with("m1(")) continue;
    if (inside && word.starts_with("order")) line = "order = 0";
    out += line;
    out += '\n';
  }
  return out;
}

std::string classical() {
  std::ifstream file(std::string(FLOATFRAME_TEST_DATA) + "/fe/classical.SID_FEM");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(SidFile, WrittenComesBack) {
  for (const FlexibleBody& body : bodies()) {
    SCOPED_TRACE(body.modes());
    const SidBody read = parse_sid(write_sid(body, "a body"), "body.SID_FEM");
    expect_same_mass(body, read.body, 1e-10);
    EXPECT_TRUE(read.notes.empty()) << read.notes.front();
    // More than the classical file: Oe has its first-order terms, so nothing is lost.
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3 && body.modes() > 0; ++j) {
        EXPECT_LT(relative_error(read.body.invariants.Sij[i][j], body.invariants.Sij[i][j]), 1e-10);
      }
    }
    if (body.modes() > 0) {
      EXPECT_LT(relative_error(read.body.K, body.K), 1e-14);
      EXPECT_LT(relative_error(read.body.D, body.D), 1e-14);
    }
    ASSERT_EQ(read.body.nodes.size(), body.nodes.size());
    for (std::size_t i = 0; i < body.nodes.size(); ++i) {
      EXPECT_EQ(read.body.nodes[i].name, std::to_string(i + 1));
      EXPECT_LT((read.body.nodes[i].p - body.nodes[i].p).norm(), 1e-14);
      if (body.modes() == 0) continue;
      EXPECT_LT((read.body.nodes[i].X - body.nodes[i].X).norm(), 1e-14);
      EXPECT_LT((read.body.nodes[i].X_theta - body.nodes[i].X_theta).norm(), 1e-13);
    }
    EXPECT_EQ(read.body.mode_names.size(), static_cast<std::size_t>(body.modes()));
  }
}

TEST(SidFile, ClassicalFileKeepsFirstOrderAndTrace) {
  FlexibleBody beam = beam_body();
  beam.second_order = nullptr;  // tests/formats/sid_second_order_test.cpp
  for (const FlexibleBody& body : {random_body(21, 4), beam}) {
    const SidBody read = parse_sid(without_second_order(write_sid(body, "")), "body.SID_FEM");
    expect_same_mass(body, read.body, 1e-10);
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_TRUE(read.notes[0].ends_with(
        "The file has no second-order inertia terms: the mass matrix at zero deformation and its "
        "first derivative are exact, its second derivative and softening by spin are not (S^11, "
        "S^22 and S^33 are each taken as a third of Me)"))
        << read.notes[0];
    // The trace of the inertia tensor is exact, the tensor is not, the mass matrix stays positive.
    Random random(5);
    const VecX y = random.vector(body.modes());
    const MatX M = mass_matrix(read.body, y), exact = mass_matrix(body, y);
    const double trace = exact.block<3, 3>(3, 3).trace();
    EXPECT_NEAR((M.block<3, 3>(3, 3).trace()), trace, 1e-10 * trace);
    EXPECT_GT(relative_error(M, exact), 1e-3);
    // Differences S^ij - S^ji are exact as well: gyroscopic forces between modes.
    const auto& a = body.invariants.Sij;
    const auto& b = read.body.invariants.Sij;
    EXPECT_LT((b[0][1] - b[1][0] - a[0][1] + a[1][0]).norm(), 1e-10 * (a[0][1].norm() + 1e-6));
  }
}

/// The blocks that the mass matrix does not contain, against the velocity-dependent forces of the
/// inertia room: Qv = -(w x (w x mc) + 2 w x Ct^T qdot, w x J w + Gr qdot w, Ge qdot w + Oe w w).
TEST(SidFile, GyroscopicBlocksAreTheVelocityForces) {
  Random random(7);
  const int nm = 5;
  const FlexibleBody body = random_body(8, nm);
  const SidContent c = sid_content(body);
  const PreprocessingData data(body.invariants);
  PreprocessingWorkspace work(nm);
  MatX M(6 + nm, 6 + nm);
  VecX Qv(6 + nm);
  for (int i = 0; i < 5; ++i) {
    const Vec3 w = random.vec3(3.0);
    const VecX qdot = random.vector(nm), y = random.vector(nm), zero = VecX::Zero(nm);
    const auto forces = [&](const VecX& q, const VecX& rate) {
      relative_preprocessing(data, Vec3::Zero(), Mat3::Identity(), w, q.data(), rate.data(), work,
                             M, Qv);
      return VecX(-Qv);
    };
    VecX ww(6);
    ww << w(0) * w(0), w(1) * w(1), w(2) * w(2), w(0) * w(1), w(1) * w(2), w(0) * w(2);
    MatX Oe = c.Oe.m0;
    for (int k = 0; k < nm; ++k) Oe += c.Oe.m1[k] * y(k);
    EXPECT_LT(relative_error(Oe * ww, forces(y, zero).tail(nm)), 1e-12);

    Mat3 Gr = Mat3::Zero();
    MatX Ge = MatX::Zero(nm, 3);
    for (int k = 0; k < nm; ++k) {
      Gr += c.Gr.m0.middleCols<3>(3 * k) * qdot(k);
      Ge += c.Ge.m0.middleCols<3>(3 * k) * qdot(k);
    }
    const Vec3 mc = c.mdCM.m0;
    VecX expected(6 + nm);
    expected.head<3>() = w.cross(w.cross(mc)) + 2.0 * w.cross(Vec3(c.Ct.m0.transpose() * qdot));
    expected.segment<3>(3) = w.cross(Vec3(body.invariants.inertia_about_origin() * w)) + Gr * w;
    expected.tail(nm) = Ge * w + c.Oe.m0 * ww;
    EXPECT_LT(relative_error(forces(zero, qdot), expected), 1e-12);
  }
}

TEST(SidFile, SelfTests) {
  // (a) Ct = m1 of mdCM transposed; (b) translation modes: Me = m I, Ct = m I.
  Random random(9);
  PointMasses points = random_point_masses(random, 6, 5);
  for (Mat3X& X : points.X) X.leftCols<3>().setIdentity();
  const SidContent c = sid_content(body_of(points, 5));
  for (int k = 0; k < 5; ++k) {
    EXPECT_LT((c.mdCM.m1[k] - c.Ct.m0.row(k).transpose()).norm(), 1e-14);
  }
  EXPECT_LT((c.Me.m0.topLeftCorner<3, 3>() - c.mass * Mat3::Identity()).norm(), 1e-13);
  EXPECT_LT((c.Ct.m0.topRows<3>() - c.mass * Mat3::Identity()).norm(), 1e-13);
  // Products of inertia of J are those of the tensor: J12 = - int x y dm.
  double xy = 0.0;
  for (std::size_t i = 0; i < points.m.size(); ++i) {
    xy += points.m[i] * points.p[i].x() * points.p[i].y();
  }
  EXPECT_NEAR(c.J.m0(3, 0), -xy, 1e-14);
}

/// A moment of inertia below zero about the centre of mass, hidden by the distance of the centre
/// from the origin.
TEST(SidFile, InertiaAboutTheCentreOfMass) {
  Random random(12);
  PointMasses points = random_point_masses(random, 8, 2);
  for (Vec3& p : points.p) p += Vec3(3000.0, 4000.0, 0.0);
  FlexibleBody body = body_of(points, 2);
  body.K = 1e4 * MatX::Identity(2, 2);
  const auto error = [](const SidContent& content) {
    return error_of([&] { sid_body(content, "far.SID_FEM"); });
  };
  SidContent c = sid_content(body);
  EXPECT_EQ(error(c), "no error");
  c.J.line = 7;
  const double about_centre = body.invariants.inertia_about_centre()(2, 2);
  c.J.m0(2, 0) -= 3.0 * about_centre;
  EXPECT_EQ(error(c), "far.SID_FEM:7: out_of_range") << error(c);
  c.J.m0(2, 0) += 7.0 * about_centre;
  EXPECT_EQ(error(c), "far.SID_FEM:7: wrong_value") << error(c);
  c = sid_content(body);
  c.Me.m0 *= 0.01;
  EXPECT_EQ(error(c), "far.SID_FEM: out_of_range") << error(c);
  c = sid_content(body);
  c.Ke.m0 *= -1.0;
  EXPECT_EQ(error(c), "far.SID_FEM: out_of_range") << error(c);
}

/// tests/data/fe/classical.SID_FEM: four points with two modes in the classical dialect (12 digits,
/// D exponents, zeros left out, structures 0 to 4, Oe of order 0).
TEST(SidFile, ClassicalDialect) {
  PointMasses points;
  points.m = {1.5, 0.5, 0.75, 1.25};
  points.p = {{0, 0, 0}, {0.8, 0.1, 0}, {0.2, 0.6, -0.1}, {0.3, -0.2, 0.5}};
  const double raw[4][2][3] = {{{0, 0, 0}, {0.2, 0.1, 0}},
                               {{0.1, 0.4, -0.2}, {0, 0.3, 0.7}},
                               {{0.3, 0, 0.5}, {0.4, -0.5, 0.1}},
                               {{-0.2, 0.1, 0.6}, {0, 0.2, -0.3}}};
  for (const auto& node : raw) {
    Mat3X X(3, 2);
    for (int k = 0; k < 2; ++k) X.col(k) = Vec3(node[k][0], node[k][1], node[k][2]);
    points.X.push_back(X);
  }
  const auto product = [&](int a, int b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      sum += points.m[i] * points.X[i].col(a).dot(points.X[i].col(b));
    return sum;
  };
  const double n0 = std::sqrt(product(0, 0));
  for (Mat3X& X : points.X) X.col(0) /= n0;
  const double g = product(0, 1);
  for (Mat3X& X : points.X) X.col(1) -= g * X.col(0);
  const double n1 = std::sqrt(product(1, 1));
  for (Mat3X& X : points.X) X.col(1) /= n1;

  const SidBody read = read_sid(std::string(FLOATFRAME_TEST_DATA) + "/fe/classical.SID_FEM");
  expect_same_mass(body_of(points, 2), read.body, 1e-11);
  EXPECT_EQ(read.notes.size(), 1u);
  EXPECT_EQ(read.body.K(0, 1), -12.5);
  EXPECT_EQ(read.body.K(1, 0), -12.5);
  EXPECT_EQ(read.body.D(1, 1), 0.75);
  EXPECT_EQ(read.body.mode_names[1], "Eigen Mode    8");
  ASSERT_EQ(read.body.nodes.size(), 2u);
  EXPECT_EQ(read.body.nodes[0].name, "6022");
  EXPECT_LT((read.body.nodes[0].X - points.X[1]).norm(), 1e-11);
  EXPECT_EQ(read.body.nodes[0].X_theta(2, 1), -2.0);
}

TEST(SidFile, DoubtfulValuesAreNoted) {
  const auto noted = [](const std::string& from, const std::string& to, const std::string& note) {
    std::string text = classical();
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const SidBody read = parse_sid(text, "arm.SID_FEM");
    for (const std::string& n : read.notes) {
      if (n.starts_with(note)) return;
    }
    for (const std::string& n : read.notes) ADD_FAILURE() << n;
  };
  noted(
      "m0( 1, 1)             = 7.11932677671D-01\n                          m0( 1, 2)",
      "m0( 1, 1)             = 9.11932677671D-01\n                          m0( 1, 2)",
      "arm.SID_FEM:214: block Gr differs from what J and Cr imply by 0.22 of its largest entry; J "
      "and Cr are used");
  noted("m1( 2, 1, 1)          = 1.99205452045D-01", "m1( 2, 1, 1)          =-1.99205452045D-01",
        "arm.SID_FEM:186: the terms of m1 of Cr of two modes must change sign when the modes are "
        "exchanged; a part of 0.2 of the modal mass that does not is left out");
  noted("m0( 3, 3)             = 1.00000000000D+00", "m0( 3, 3) = -1",
        "arm.SID_FEM:56: node 6022 has axes that are turned against the body's (AP); its own "
        "orientation is left out");
  // Geometric stiffening in Oe: its first-order terms are not those of inertia.
  std::string text = write_sid(random_body(31, 2), "");
  const std::size_t Oe = text.find("           Oe\n");
  const std::size_t m1 = text.find("m1( 1, 1, 1)", Oe);
  const std::size_t value = text.find('=', m1);
  text.replace(value, text.find('\n', value) - value, "= 9");
  const SidBody read = parse_sid(text, "arm.SID_FEM");
  ASSERT_EQ(read.notes.size(), 1u);
  EXPECT_TRUE(contains(read.notes[0], "m1 of Oe does not give the modal masses"));
}

struct SidError {
  const char* from;
  const char* to;
  const char* expected;
};

TEST(SidFile, Errors) {
  const SidError errors[] = {
      {"    2   2    :No", "    two   2    :No", "arm.SID_FEM:1: wrong_value"},
      {"    2   2    :No", "    2   900000000  :No", "arm.SID_FEM:1: too_large"},
      {"    2   2    :No", "    3   2    :No", "arm.SID_FEM:10: contradiction"},
      {"nelastq                         =     2", "nelastq = 3", "arm.SID_FEM:6: contradiction"},
      {"mass                            = 4.00000000000D+00", "mass = -4",
       "arm.SID_FEM:5: out_of_range"},
      {"nrow                  =    6", "nrow = 5", "arm.SID_FEM:148: wrong_value"},
      {"m0( 5, 1)             =-1.72500000000D-01", "nrow = 3", "arm.SID_FEM:157: wrong_value"},
      {"m0( 2, 1)             = 2.50000000000D-01", "m0( 2, 1) = 2.5D-0x",
       "arm.SID_FEM:137: not_a_number"},
      {"m0( 2, 1)             = 2.50000000000D-01", "m0( 4, 1) = 2.5D-01",
       "arm.SID_FEM:137: wrong_count"},
      {"m0( 2, 1)             = 2.50000000000D-01", "m0( 1, 1) = 2.5D-01",
       "arm.SID_FEM:137: duplicate"},
      {"           Gr\n", "           Gz\n", "arm.SID_FEM:214: unknown_key"},
      {"m0( 1, 3)             = 1.09733984152D+00", "m0( 1, 3) = 1.1",
       "arm.SID_FEM:172: contradiction"},
      {"m0( 2, 2)             = 7.50000000000D-01", "m0( 2, 1)             = 7.50000000000D-01",
       "arm.SID_FEM:301: contradiction"},
  };
  const auto error_in = [](const std::string& text) {
    return error_of([&] { parse_sid(text, "arm.SID_FEM"); });
  };
  for (const SidError& c : errors) {
    std::string text = classical();
    const std::size_t at = text.find(c.from);
    ASSERT_NE(at, std::string::npos) << c.from;
    text.replace(at, std::string(c.from).size(), c.to);
    const std::string what = error_in(text);
    EXPECT_EQ(what.substr(0, what.find('\n')), c.expected);
  }
  const std::string text = classical();
  EXPECT_EQ(error_in(text.substr(0, text.find(" end part"))), "arm.SID_FEM:303: damaged");
  EXPECT_EQ(error_in(text.substr(0, text.find("           Ke\n"))), "arm.SID_FEM:281: damaged");
  std::string wrong = text;
  const std::size_t Me = wrong.find("mass                            = 4");
  wrong.replace(Me, 36, "mass = 0.1");
  EXPECT_EQ(error_in(wrong), "arm.SID_FEM:146: out_of_range");
}

}  // namespace
}  // namespace floatframe::test
