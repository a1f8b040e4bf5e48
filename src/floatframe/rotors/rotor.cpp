#include "floatframe/rotors/rotor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/body/cut_pair.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/element_evaluation.hpp"
#include "floatframe/rotors/rotor_symmetry.hpp"

namespace floatframe {
namespace {

int joint_named(const Model& model, const std::string& name) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    if (model.joints[k].name == name) return static_cast<int>(k);
    names.push_back(model.joints[k].name);
  }
  throw InputError(ErrorCode::not_found, fmt::format("unknown joint '{}' of a rotor{}",
                                                     excerpt(name), did_you_mean(name, names)));
}

/// The bodies below `root` in the tree, itself first.
std::vector<int> bodies_below(const TreeKinematics& tree, int root) {
  std::vector<int> found{root};
  for (const int i : tree.order())
    if (std::find(found.begin(), found.end(), tree.body(i).parent) != found.end() && i != root)
      found.push_back(i);
  return found;
}

void require_one_piece(const Model& model, const TreeKinematics& tree, const Rotor& rotor,
                       const std::vector<int>& bodies) {
  for (const int i : bodies)
    if (i != rotor.body && tree.body(i).nj > 0)
      throw InputError(
          ErrorCode::unsupported,
          fmt::format("rotor on joint '{}': body '{}' moves on the rotor by joint '{}', expected "
                      "bodies of a rotor that are welded to each other",
                      rotor.name, model.bodies[i].name, model.joints[tree.body(i).joint].name));
}

Pose marker_pose(const Model& model, int index) {
  const Marker& m = model.markers[index];
  Pose X = m.X_NM;
  if (m.body < 0) return X;
  const Body& b = model.bodies[m.body];
  if (m.node >= 0) X.p += b.data->nodes[m.node].p;
  return b.X_WB * X;
}

RotorBody rotor_body(const Body& b, int index, const Vec3& p_W, const Vec3& axis_W) {
  RotorBody r;
  r.body = index;
  r.axis = (b.X_WB.R.transpose() * axis_W).normalized();
  const Vec3 p_B = b.X_WB.inverse() * p_W;
  r.p_BP = p_B - r.axis * r.axis.dot(p_B);  // nearest the origin of the frame
  for (std::size_t k = 0; k < b.data->nodes.size(); ++k) {
    const Vec3 from = b.data->nodes[k].p - r.p_BP;
    if ((from - r.axis * r.axis.dot(from)).norm() < 1e-6 * b.length)
      r.on_axis.push_back(static_cast<int>(k));
  }
  r.G = turning_of_modes(*b.data, r.axis, r.p_BP, r.on_axis);
  return r;
}

/// Of two values a <= b of w0^2 / (w0^2 + w^2), from 0 (stiff or without mass) to 1 (loose).
bool equal_modes(double a, double b) {
  return b - a <= 2.0 * equal_frequencies * b * std::max(1.0 - b, 0.0) + 1e-11;
}

/// Components visible at the axis: rows of three, columns of modes, lengths.
std::vector<Mat3X> seen_from_axis(const FlexibleBody& body, const Vec3& p_BP,
                                  const std::vector<int>& on_axis) {
  const InertiaInvariants& I = body.invariants;
  double length = 1e-9;
  for (const ModalNode& n : body.nodes) length = std::max(length, (n.p - p_BP).norm());
  std::vector<Mat3X> seen;
  if (I.m > 0.0) {
    seen.push_back(I.S / I.m);
    Mat3X moment(3, I.modes());  // int r x X dm, r from P
    for (int k = 0; k < I.modes(); ++k) {
      const Vec3 s = I.S.col(k);
      moment.col(k) = Vec3(I.Si[1](2, k) - I.Si[2](1, k), I.Si[2](0, k) - I.Si[0](2, k),
                           I.Si[0](1, k) - I.Si[1](0, k)) -
                      p_BP.cross(s);
    }
    seen.push_back(moment / (I.m * length));
  }
  for (const int k : on_axis) {
    const ModalNode& n = body.nodes[k];
    seen.push_back(n.X);
    seen.push_back(length * n.X_theta);
  }
  return seen;
}

/// The skew matrix that fits e x x = x G best; zero without any component.
MatX fitted_turning(const std::vector<Mat3X>& seen, const MatX& columns, const Vec3& axis,
                    double visible) {
  const Eigen::Index n = columns.cols(), unknowns = n * (n - 1) / 2;
  MatX G = MatX::Zero(n, n);
  MatX A = MatX::Zero(unknowns, unknowns);
  VecX b = VecX::Zero(unknowns);
  double size = 0.0;
  for (const Mat3X& all : seen) {
    const MatX x = all * columns, turned = skew(axis) * x;
    size = std::max(size, (x - axis * (axis.transpose() * x)).cwiseAbs().maxCoeff());
    const auto row_of = [&](Eigen::Index i, Eigen::Index j) {  // d(x G)/dG_ij, G_ji = -G_ij
      MatX d = MatX::Zero(3, n);
      d.col(j) = x.col(i);
      d.col(i) = -x.col(j);
      return d;
    };
    Eigen::Index r = 0;
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = i + 1; j < n; ++j, ++r) {
        const MatX d = row_of(i, j);
        b[r] += d.cwiseProduct(turned).sum();
        Eigen::Index c = 0;
        for (Eigen::Index k = 0; k < n; ++k)
          for (Eigen::Index l = k + 1; l < n; ++l, ++c)
            A(r, c) += d.cwiseProduct(row_of(k, l)).sum();
      }
  }
  if (unknowns == 0 || size < visible) return G;
  const VecX g = LeastNorm(A, 1e-10).solve(b);
  Eigen::Index r = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = i + 1; j < n; ++j, ++r) {
      G(i, j) = g[r];
      G(j, i) = -g[r];
    }
  return G;
}

/// The axis of rotation of the body attached to the joint, undeformed.
Vec3 axis_in_body(RelativeFormulation& f, const Rotor& rotor) {
  VecX q, v;
  f.start(q, v);
  const TreeBody& b = f.tree().body(rotor.body);
  q.segment(b.iyq, b.nm).setZero();
  v.setZero();
  f.positions(0.0, q);
  if (rotor.free)
    v.segment<3>(rotor.coordinate) = b.motion.R_FM * rotor.axis_F;
  else
    v[rotor.coordinate] = rotor.sign;
  f.velocities(v);
  const BodyKinematics& turning = f.motion().body(rotor.body);
  return (turning.R_WB.transpose() * turning.w_WB).normalized();
}

}  // namespace

MatX turning_of_modes(const FlexibleBody& body, const Vec3& axis, const Vec3& p_BP,
                      const std::vector<int>& on_axis) {
  const Eigen::Index nm = body.modes();
  MatX G = MatX::Zero(nm, nm);
  if (nm == 0) return G;
  const InertiaInvariants& I = body.invariants;
  const MatX M = I.Sij[0][0] + I.Sij[1][1] + I.Sij[2][2];
  // Modes may lack mass (torsion of thin bars) or stiffness, but not both.
  const double scale = body.K.trace() / std::max(M.trace(), 1e-300);
  const MatX metric = body.K + scale * M;
  const SymmetricEigen e = generalised_eigen(scale * M, metric);  // w0^2 / (w0^2 + w^2)
  if (!e.found) return G;
  const std::vector<Mat3X> seen = seen_from_axis(body, p_BP, on_axis);
  double largest_seen = 0.0;
  for (const Mat3X& x : seen)
    largest_seen = std::max(largest_seen, (x * e.vectors).cwiseAbs().maxCoeff());
  MatX modal = MatX::Zero(nm, nm);
  for (Eigen::Index first = 0; first < nm;) {
    Eigen::Index end = first + 1;
    while (end < nm && equal_modes(e.values[end - 1], e.values[end])) ++end;
    modal.block(first, first, end - first, end - first) =
        fitted_turning(seen, e.vectors.middleCols(first, end - first), axis, 1e-9 * largest_seen);
    first = end;
  }
  return e.vectors * modal * (e.vectors.transpose() * metric);
}

MatX turned_modes(const MatX& G, double angle) {
  const Eigen::Index n = G.rows();
  const double size = n > 0 ? std::abs(angle) * G.cwiseAbs().rowwise().sum().maxCoeff() : 0.0;
  const int halvings = size > 0.1 ? static_cast<int>(std::ceil(std::log2(size / 0.1))) : 0;
  const MatX A = angle * std::ldexp(1.0, -halvings) * G;
  MatX D = MatX::Identity(n, n), term = D;
  for (int k = 1; k <= 12; ++k) {
    term = (term * A / k).eval();
    D += term;
  }
  for (int k = 0; k < halvings; ++k) D = (D * D).eval();
  return D;
}

std::vector<int> rotor_bodies(const Model& model, const std::string& joint) {
  const RelativeFormulation f(model, model.simulation.inertia);
  const int body = f.tree().body_of_joint(joint_named(model, joint));
  return body < 0 ? std::vector<int>{} : bodies_below(f.tree(), body);
}

namespace {

void require_no_states(const Model& model, const std::string& rotor) {
  for (const Element& e : model.elements)
    if (e.states > 0 || link_count(e) > 0)
      throw InputError(
          ErrorCode::unsupported,
          fmt::format("rotor on joint '{}': found {}, an element with {}, expected a model "
                      "without: the analyses of rotors do not know them",
                      rotor, element_name(e),
                      e.states > 0 ? "states" : "signals of other elements"));
}

}  // namespace

Rotor find_rotor(RelativeFormulation& f, const std::string& name, const std::optional<Vec3>& axis) {
  const Model& model = f.model();
  const TreeKinematics& tree = f.tree();
  Rotor rotor;
  rotor.joint = joint_named(model, name);
  rotor.name = name;
  require_no_states(model, name);
  const Joint& joint = model.joints[rotor.joint];
  rotor.body = tree.body_of_joint(rotor.joint);
  if (rotor.body < 0)
    throw InputError(ErrorCode::unsupported,
                     fmt::format("rotor on joint '{}': the joint is cut to open a loop, expected "
                                 "one that a rotor hangs on",
                                 name));
  const TreeBody& b = tree.body(rotor.body);
  rotor.free = joint.type == JointType::free;
  rotor.driven = joint.motion >= 0;
  if (joint.type == JointType::revolute) {
    rotor.coordinate = b.iv;
  } else if (joint.type == JointType::cylindrical) {
    rotor.coordinate = b.iv + 1;
  } else if (rotor.free) {
    rotor.coordinate = b.iv + 3;
  } else {
    throw InputError(
        ErrorCode::unsupported,
        fmt::format(
            "rotor on joint '{}': found a {} joint, expected a revolute, cylindrical or free one",
            name, joint_type_name(joint.type)));
  }
  const std::vector<int> bodies = bodies_below(tree, rotor.body);
  require_one_piece(model, tree, rotor, bodies);
  rotor.sign = b.reversed && !rotor.free ? -1.0 : 1.0;
  const Body& first = model.bodies[rotor.body];
  Mat3 axes = Mat3::Identity();
  for (int k = 0; rotor.free && k < 3; ++k) {
    rotor.axis_F = Vec3::Unit(k);
    axes.col(k) = first.X_WB.R * axis_in_body(f, rotor);
  }
  if (rotor.free)
    rotor.axis_F =
        axis ? axis->normalized() : Vec3(Vec3::Unit(fitting_axis(model, name, bodies, axes)));
  const Vec3 axis_W = first.X_WB.R * axis_in_body(f, rotor);
  if (rotor.free) rotor.other_axis = other_axis_of_bearings(model, bodies, axes, axis_W);
  const Vec3 p_W = marker_pose(model, b.frame_M).p;
  Eigen::Index along = 2;
  if (rotor.free) rotor.axis_F.cwiseAbs().maxCoeff(&along);
  rotor.e_1 = marker_pose(model, joint.frame_F).R.col((along + 1) % 3);
  rotor.e_1 = (rotor.e_1 - axis_W * axis_W.dot(rotor.e_1)).normalized();
  rotor.length = 0.0;
  for (const int i : bodies) {
    const Body& body = model.bodies[i];
    rotor.bodies.push_back(rotor_body(body, i, p_W, axis_W));
    rotor.length = std::max(rotor.length, body.length);
  }
  return rotor;
}

}  // namespace floatframe
