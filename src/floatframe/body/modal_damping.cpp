#include "floatframe/body/modal_damping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/enum_index.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

constexpr NumberRule damping_fraction{"a fraction of critical damping from 0 to 1", "", 0.0, 1.0};
constexpr const char* damping_reference_words[] = {"frame", "free", "mounted"};

/// Below this fraction of the largest 1/w^2 a mode is taken as massless: rounding.
constexpr double massless_share = 1e-14;
/// Rank of the conditions of interfaces, all of them displacements of about the same size.
constexpr double interface_rank = 1e-9;

/// Motions z = (q_r, y) with rotations of the frame as displacements of a length, and their M(0).
struct BodyMotions {
  explicit BodyMotions(const FlexibleBody& body)
      : length(std::sqrt(
            std::max(body.invariants.inertia_about_origin().trace() / body.invariants.m, 1e-300))),
        M(mass_matrix_at_rest(body.invariants)) {
    if (!std::isfinite(length)) length = 1.0;
    M.middleRows<3>(3) /= length;
    M.middleCols<3>(3) /= length;
  }
  double length;  ///< radius of gyration about the origin of the frame [m]
  MatX M;         ///< (6 + nm) x (6 + nm)
};

/// M_ff without the part of rigid motions Z: motions (Z a + P x) of least kinetic energy.
MatX mass_of(const MatX& M, const MatX& P, const MatX& Z) {
  MatX own = P.transpose() * M * P;
  if (Z.cols() == 0) return own;
  const MatX coupling = Z.transpose() * M * P;
  const SymmetricEigen rigid = symmetric_eigen(Z.transpose() * M * Z);
  const double top = rigid.values.size() > 0 ? rigid.values.cwiseAbs().maxCoeff() : 0.0;
  for (Eigen::Index k = 0; k < rigid.values.size(); ++k) {
    if (!(rigid.values(k) > 1e-10 * top)) continue;  // a bar about its axis
    const VecX g = coupling.transpose() * rigid.vectors.col(k);
    own -= g * g.transpose() / rigid.values(k);
  }
  return 0.5 * (own + own.transpose());
}

/// Appends the modes of shapes `Y` with mass `M` among them.
void append(const MatX& K, const MatX& Y, const MatX& M, ReferenceModes& modes) {
  const Eigen::Index n = Y.cols(), old = modes.mu.size();
  if (n == 0) return;
  const SymmetricEigen inverse = generalised_eigen(M, Y.transpose() * K * Y);
  if (!inverse.found)
    throw InputError(ErrorCode::singular,
                     "modal damping needs a positive definite modal stiffness");
  modes.Y.conservativeResize(K.rows(), old + n);
  modes.mu.conservativeResize(old + n);
  for (Eigen::Index i = 0; i < n; ++i) {  // 1/w^2 descends
    modes.Y.col(old + i) = Y * inverse.vectors.col(n - 1 - i);
    modes.mu(old + i) = std::max(0.0, inverse.values(n - 1 - i));
  }
}

/// Rows B of B z = 0, rotations as displacements.
MatX interface_rows(const FlexibleBody& body, double length) {
  const Eigen::Index nm = body.modes();
  MatX B(0, 6 + nm);
  for (const InterfaceDofs& at : body.interfaces) {
    if (at.node < 0 || at.node >= static_cast<int>(body.nodes.size())) continue;
    const ModalNode& node = body.nodes[at.node];
    Mat6X z = Mat6X::Zero(6, 6 + nm);
    z.topLeftCorner<3, 3>().setIdentity();
    z.block<3, 3>(0, 3) = -skew(node.p) / length;
    z.block<3, 3>(3, 3).setIdentity();
    z.topRightCorner(3, nm) = node.X;
    z.bottomRightCorner(3, nm) = length * node.X_theta;
    for (Eigen::Index k = 0; k < 6; ++k) {
      if (((at.mask >> static_cast<unsigned>(k)) & 1u) == 0) continue;
      B.conservativeResize(B.rows() + 1, Eigen::NoChange);
      B.row(B.rows() - 1) = z.row(k);
    }
  }
  return B;
}

/// Amplitudes that make each mode a displacement of about 1: of unit mean square over the mass; of
/// modes without mass by their stiffness.
VecX amplitude_sizes(const FlexibleBody& body) {
  const MatX M = modal_mass(body.invariants);
  const Eigen::Index nm = body.modes();
  VecX size(nm);
  const double top = M.diagonal().maxCoeff();
  double fastest = 0.0;
  for (Eigen::Index k = 0; k < nm; ++k)
    if (M(k, k) > massless_share * top) fastest = std::max(fastest, body.K(k, k) / M(k, k));
  for (Eigen::Index k = 0; k < nm; ++k) {
    const double mass = M(k, k) > massless_share * top ? M(k, k) : body.K(k, k) / fastest;
    size(k) = mass > 0.0 && std::isfinite(mass) ? std::sqrt(body.invariants.m / mass) : 1.0;
  }
  return size;
}

ReferenceModes mounted_modes(const FlexibleBody& body, const BodyMotions& motions) {
  const Eigen::Index nm = body.modes();
  ReferenceModes modes{MatX(nm, 0), VecX(0), 0};
  VecX size = VecX::Ones(6 + nm);
  size.tail(nm) = amplitude_sizes(body);
  const MatX B = interface_rows(body, motions.length) * size.asDiagonal();
  MatX N = MatX::Identity(6 + nm, 6 + nm);
  if (B.rows() > 0) {
    const PivotedQr rows = pivoted_qr(B.transpose(), interface_rank);
    N = rows.Q.rightCols(6 + nm - rows.rank).eval();
  }
  if (N.cols() > 0) {
    // The remainder may include rigid motions: rotations about an interface without rotations.
    const MatX Ny = N.bottomRows(nm);
    const PivotedQr elastic = pivoted_qr(Ny.transpose(), interface_rank);
    const MatX P = size.asDiagonal() * (N * elastic.Q.leftCols(elastic.rank));
    MatX Z = N * elastic.Q.rightCols(N.cols() - elastic.rank);
    Z.bottomRows(nm).setZero();
    append(body.K, P.bottomRows(nm), mass_of(motions.M, P, Z), modes);
  }
  modes.held = modes.mu.size();
  // Deformations by motions of the interfaces: the complement orthogonal to these in K.
  const VecX s = body.K.diagonal().cwiseSqrt().cwiseInverse();
  MatX W = MatX::Identity(6 + nm, 6 + nm).rightCols(nm);
  if (modes.held > 0) {
    const PivotedQr held = pivoted_qr(s.asDiagonal() * (body.K * modes.Y), interface_rank);
    W = W * s.asDiagonal() * held.Q.rightCols(nm - held.rank);
  }
  const MatX rigid = MatX::Identity(6 + nm, 6);
  append(body.K, W.bottomRows(nm), mass_of(motions.M, W, rigid), modes);
  return modes;
}

double fraction_of(const ModalDamping& damping, Eigen::Index mode, double frequency) {
  if (!damping.bands.empty()) {
    for (const DampingBand& band : damping.bands)
      if (frequency < band.below) return band.fraction;
    return damping.bands.back().fraction;
  }
  const std::size_t k = mode;
  return k < damping.fractions.size() ? damping.fractions[k] : damping.fractions.back();
}

}  // namespace

const char* word(DampingReference reference) noexcept {
  return damping_reference_words[index_of(reference)];
}

bool ModalDamping::none() const noexcept {
  const auto zero = [](double x) { return x == 0.0; };
  return std::all_of(fractions.begin(), fractions.end(), zero) && bands.empty() && alpha == 0.0 &&
         beta == 0.0;
}

std::vector<DampingBand> usual_damping_bands() {
  DampingBand above;
  above.fraction = 1.0;
  return {{100.0, 0.01}, {1000.0, 0.1}, above};
}

std::optional<std::string> damping_complaint(const ModalDamping& d) {
  const bool rayleigh = d.alpha != 0.0 || d.beta != 0.0;
  if (static_cast<int>(!d.fractions.empty()) + static_cast<int>(!d.bands.empty()) +
          static_cast<int>(rayleigh) >
      1)
    return "found more than one of fractions, bands and Rayleigh's factors, expected one";
  for (const double x : d.fractions)
    if (auto complaint = damping_fraction.complaint(x)) return complaint;
  double last = 0.0;
  for (const DampingBand& band : d.bands) {
    if (auto complaint = damping_fraction.complaint(band.fraction)) return complaint;
    if (!(band.below > last))
      return fmt::format(
          "found a band below {:g} Hz after one below {:g} Hz, expected ascending frequencies "
          "above 0",
          band.below, last);
    last = band.below;
  }
  if (!d.bands.empty() && std::isfinite(last))
    return fmt::format(
        "the last band ends at {:g} Hz, expected the fraction above it as the last item of the "
        "list",
        last);
  for (const double x : {d.alpha, d.beta})
    if (auto complaint = non_negative_number("1/s, s").complaint(x)) return complaint;
  if (d.interface_frequency != 0.0)
    if (auto complaint = positive_number("Hz").complaint(d.interface_frequency)) return complaint;
  if (d.interface_frequency > 0.0 && d.reference != DampingReference::mounted)
    return "found a frequency of the interfaces' motions, which belongs to the reference mounted";
  return std::nullopt;
}

ReferenceModes reference_modes(const FlexibleBody& body, DampingReference reference) {
  const Eigen::Index nm = body.modes();
  ReferenceModes modes{MatX(nm, 0), VecX(0), 0};
  if (nm == 0) return modes;
  if (reference == DampingReference::frame) {
    append(body.K, MatX::Identity(nm, nm), modal_mass(body.invariants), modes);
    modes.held = nm;
    return modes;
  }
  const BodyMotions motions(body);
  if (reference == DampingReference::mounted) return mounted_modes(body, motions);
  const MatX all = MatX::Identity(6 + nm, 6 + nm);
  append(body.K, MatX::Identity(nm, nm), mass_of(motions.M, all.rightCols(nm), all.leftCols(6)),
         modes);
  modes.held = nm;
  return modes;
}

MatX damping_matrix(const FlexibleBody& body, const ModalDamping& damping) {
  if (const auto complaint = damping_complaint(damping))
    throw InputError(ErrorCode::out_of_range, "damping: " + *complaint);
  const Eigen::Index nm = body.modes();
  MatX D = MatX::Zero(nm, nm);
  if (damping.none() || nm == 0) return D;
  if (damping.reference == DampingReference::mounted && body.interfaces.empty())
    throw InputError(ErrorCode::missing,
                     "damping: the reference is mounted, but the body has no interface that could "
                     "be held; give an interface, or take the reference free");
  const ReferenceModes modes = reference_modes(body, damping.reference);
  const auto count = modes.mu.size();
  if (static_cast<Eigen::Index>(damping.fractions.size()) > count)
    throw InputError(ErrorCode::wrong_count,
                     fmt::format("damping: found {} fractions, but the body has {} mode{}",
                                 damping.fractions.size(), count, count == 1 ? "" : "s"));
  const bool rayleigh = damping.alpha != 0.0 || damping.beta != 0.0;
  const double slowest = modes.mu.maxCoeff();
  // From the highest frequency, so that the sum is that of the smallest terms first.
  for (Eigen::Index i = count - 1; i >= 0; --i) {
    const bool massless = !(modes.mu(i) > massless_share * slowest);
    double mu = massless ? 0.0 : modes.mu(i);
    if (i >= modes.held && damping.interface_frequency > 0.0) {
      const double omega = omega_of(damping.interface_frequency);
      mu = 1.0 / (omega * omega);
    }
    double c = damping.alpha * mu + damping.beta;
    if (!rayleigh && mu > 0.0)
      c = 2.0 * fraction_of(damping, i, hertz(1.0 / std::sqrt(mu))) * std::sqrt(mu);
    if (c == 0.0) continue;
    const VecX Ky = body.K * modes.Y.col(i);
    D += c * Ky * Ky.transpose();
  }
  return 0.5 * (D + D.transpose());
}

std::vector<DampedMode> damped_modes(const FlexibleBody& body, DampingReference reference) {
  std::vector<DampedMode> out;
  if (reference == DampingReference::mounted && body.interfaces.empty()) return out;
  const ReferenceModes modes = reference_modes(body, reference);
  for (Eigen::Index k = 0; k < modes.held; ++k) {
    const double mu = modes.mu(k);
    if (!(mu > massless_share * modes.mu.head(modes.held).maxCoeff())) continue;
    double fraction = 0.0;  // y^T K y = 1: y^T M y = mu
    if (body.D.size() > 0)
      fraction = 0.5 * modes.Y.col(k).dot(body.D * modes.Y.col(k)) / std::sqrt(mu);
    out.push_back({hertz(1.0 / std::sqrt(mu)), fraction});
  }
  return out;
}

OwnDamping own_damping(const FlexibleBody& body) {
  OwnDamping out;
  if (body.D.size() == 0 || body.D.isZero(0.0) || !is_positive_definite(body.K)) return out;
  out.interfaces = !body.interfaces.empty();
  out.frame = damped_modes(body, DampingReference::frame);
  out.free = damped_modes(body, DampingReference::free);
  out.mounted = damped_modes(body, DampingReference::mounted);
  const bool same = std::equal(out.frame.begin(), out.frame.end(), out.free.begin(), out.free.end(),
                               [](const DampedMode& a, const DampedMode& b) {
                                 return std::abs(a.frequency - b.frequency) <= 1e-6 * b.frequency;
                               });
  if (same) out.frame.clear();
  return out;
}

}  // namespace floatframe
