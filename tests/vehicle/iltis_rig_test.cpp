// The suspension of the Iltis on the rig against the lengths of its links (iltis_rig.py beside the
// table): over height and rack, all four corners. The rack is moved by a formula: nothing in the
// steering gives way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floatframe/model_file/load_model.hpp"
#include "floatframe/vehicle/suspension_rig.hpp"
#include "support/figures.hpp"
#include "vehicle/single_track.hpp"

namespace floatframe::test {
namespace {

/// The row of the table for a front left wheel.
const TableRow& row_of(const std::vector<TableRow>& table, double rack, double height) {
  return *std::ranges::find_if(table, [&](const TableRow& row) {
    return std::abs(number(row, "rack") - rack) < 1e-9 &&
           std::abs(number(row, "height") - height) < 1e-9;
  });
}

/// Largest difference of a wheel; `side` 1 left, -1 right, `end` 1 front, -1 rear.
double rig_difference(const RigWheel& w, const TableRow& row, double side, double end) {
  const double steer = side * end * number(row, "steer");
  double worst = 0.0;
  for (const auto& [ours, theirs] :
       {std::pair{w.height, number(row, "height")}, std::pair{w.x, end * number(row, "x")},
        std::pair{w.y, side * number(row, "y")}, std::pair{w.steer, steer},
        std::pair{w.toe, -side * steer}, std::pair{w.camber, number(row, "camber")}})
    worst = std::max(worst, std::abs(ours - theirs));
  return worst;
}

TEST(IltisRig, IsTheKinematicsOfItsLinks) {
  const std::vector<TableRow> table = vehicle_table("iltis_rig.csv");
  double worst = 0.0;
  for (const double rack : {0.0, 0.03}) {
    const ModelDescription d =
        load_description(FLOATFRAME_EXAMPLES "/iltis/handling.yaml",
                         {{"steering", "rack"}, {"rack", rack == 0.0 ? "0" : "0.03"}});
    for (const RigSweep sweep : {RigSweep::travel, RigSweep::roll})
      for (const RigPoint& p : suspension_sweep(d, sweep, {.travel = 0.06, .points = 7})) {
        const double right = sweep == RigSweep::roll ? -p.travel : p.travel;
        for (const double end : {1.0, -1.0}) {
          const RigAxle& a = p.axles[end > 0.0 ? 0 : 1];
          const double moved = end > 0.0 ? rack : 0.0;
          const TableRow &of_left = row_of(table, moved, p.travel),
                         &of_right = row_of(table, -moved, right);
          const double track = number(of_left, "contact") + number(of_right, "contact");
          worst =
              std::max({worst, rig_difference(a.left, of_left, 1.0, end),
                        rig_difference(a.right, of_right, -1.0, end), std::abs(a.track - track)});
        }
      }
  }
  figure("suspension of the Iltis on the rig", worst);
  EXPECT_LT(worst, 1e-9);
}

}  // namespace
}  // namespace floatframe::test
