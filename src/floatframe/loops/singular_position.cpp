#include "floatframe/loops/singular_position.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "floatframe/core/plural.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model/alignment.hpp"

namespace floatframe {

namespace {

/// Rows to include: not those of prescribed motions.
MatX without_motions(const RelativeFormulation& f, const MatX& all) {
  std::vector<int> rows;
  const ConstraintSet& set = f.constraint_set();
  for (std::size_t k = 0; k < set.parts().size(); ++k)
    for (int r = 0; r < set.parts()[k].rows() && !set.parts()[k].is_motion() && !set.continues(k);
         ++r)
      rows.push_back(set.offset(k) + r);
  return all(rows, Eigen::all);
}

}  // namespace

bool may_be_singular(RelativeFormulation& f, double t, const VecX& q) {
  constexpr double nearly = 1e-8, step = 0.01;
  constexpr int most_coordinates = 100, passes = 8;  // dense linear algebra
  const VecX at_rest = VecX::Zero(f.velocities());
  if (f.velocities() > most_coordinates) return false;
  VecX there = q, from = q;
  const auto rows = [&] {
    kinematics_at(f, t, there, at_rest);
    return without_motions(f, f.constraint_jacobian());
  };
  const PivotedQr here = pivoted_qr(rows().transpose(), nearly);
  const Eigen::Index free = f.velocities() - here.rank;
  if (free == 0) return false;
  VecX x = here.Q.rightCols(free) * VecX::LinSpaced(free, 1.0, 1.5);
  f.retract(from, VecX(x * (step / largest(x))), there);
  for (int pass = 0; pass < passes; ++pass) {
    const MatX J = rows();
    const VecX gap = without_motions(f, f.constraint_values());
    if (largest(gap) < 1e-11) return pivoted_rank(J.transpose(), nearly) > here.rank;
    from = there;
    f.retract(from, VecX(-LeastNorm(J, nearly).solve(gap)), there);
  }
  return true;
}

SingularPosition singular_position(const RelativeFormulation& f, double nearly) {
  constexpr std::size_t most_bodies = 60;  // dense linear algebra
  const Model& model = f.model();
  SingularPosition found;
  std::string& text = found.sentence;
  for (const LoopBlock& block : loop_blocks(model)) {
    if (block.bodies.size() > most_bodies) continue;
    bool bends = false;
    std::vector<Pose> poses;
    for (const int b : block.bodies) {
      bends = bends || model.bodies[b].modes() > 0;
      poses.push_back({f.motion().body(b).p_WB, f.motion().body(b).R_WB});
    }
    if (bends) continue;
    const Alignment drawn(model, block);
    LoopMobility mobility(model, block, drawn.drawn(), drawn.size(), false);
    mobility.start_at(std::move(poses));
    const int free = mobility.free(nearly);
    if (free == 0) continue;
    const int lasting = mobility.lasting(MatX::Zero(mobility.columns(), 0), nearly);
    if (lasting >= free) continue;
    found.only_there += free - lasting;
    std::vector<std::string> names;
    for (const int j : block.joints) names.push_back(model.joints[j].name);
    for (const int k : block.elements) names.push_back(model.elements[k].name);
    constexpr std::size_t most = 6;
    const std::size_t more = names.size() > most ? names.size() - most : 0;
    names.resize(names.size() - more);
    const std::string listed =
        more == 0 ? named_text("joint", "joints", names)
                  : fmt::format("joints '{}' and {} more", fmt::join(names, "', '"), more);
    text += fmt::format(
        "{}the loop of {} is in a singular position: {} degree{} of freedom there, {} anywhere "
        "near, so that forces in it may be without bound and it may go on in more than one way",
        text.empty() ? "" : "; ", listed, free, free == 1 ? "" : "s", lasting);
  }
  return found;
}

}  // namespace floatframe
