// OpenCRG roads against the ASAM C-API 1.2.0 without modifiers and against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "floatframe/roads/crg_file.hpp"

namespace floatframe::test {
namespace {

const std::string folder = std::string(FLOATFRAME_TEST_DATA) + "/roads/";

struct ReferenceRow {
  bool of_uv;  ///< given: u and v, else x and y
  CrgBorder border_u, border_v;
  double u, v, x, y, z, phi, curvature;
  bool road;
};

std::vector<ReferenceRow> reference_rows(const std::string& name) {
  std::ifstream file(folder + name + ".csv");
  std::vector<ReferenceRow> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> f;
    std::stringstream parts(line);
    for (std::string part; std::getline(parts, part, ',');) f.push_back(part);
    const auto number = [&](std::size_t k) { return k < f.size() ? std::atof(f[k].c_str()) : 0.0; };
    rows.push_back({f[0] == "uv", CrgBorder(std::stoi(f[1])), CrgBorder(std::stoi(f[2])), number(3),
                    number(4), number(5), number(6), number(8), number(9), number(10),
                    f[7] == "1"});
  }
  return rows;
}

class CrgReference : public testing::TestWithParam<const char*> {};

TEST_P(CrgReference, EveryRow) {
  CrgRoad road = read_crg(std::filesystem::path(folder + GetParam() + ".crg"));
  const std::vector<ReferenceRow> rows = reference_rows(GetParam());
  ASSERT_GT(rows.size(), 100u);
  double place_error = 0.0, height_error = 0.0;
  for (const ReferenceRow& r : rows) {
    road.edge_u.mode = r.border_u;
    road.edge_v.mode = r.border_v;
    const LinePlace place = road.line.at(r.x, r.y);
    EXPECT_NEAR(place.u, r.u, 1e-8);
    EXPECT_NEAR(place.v, r.v, 1e-8);
    place_error = std::max({place_error, std::abs(place.u - r.u), std::abs(place.v - r.v)});
    const ReferenceLine::Node back = road.line.place(r.u, r.v);
    EXPECT_NEAR(back.x, r.x, 1e-8);
    EXPECT_NEAR(back.y, r.y, 1e-8);
    const CrgHeight h = crg_height(road, r.u, r.v);
    ASSERT_EQ(h.road, r.road) << r.u << " " << r.v;
    if (!r.road) {
      EXPECT_TRUE(std::isnan(crg_surface(road, r.x, r.y).z));
      continue;
    }
    EXPECT_NEAR(h.z, r.z, 1e-8) << r.u << " " << r.v;
    height_error = std::max(height_error, std::abs(crg_surface(road, r.x, r.y).z - r.z));
    EXPECT_NEAR(crg_surface(road, r.x, r.y).z, r.z, 1e-8);
    EXPECT_NEAR(road.line.heading(r.u), r.phi, 1e-8) << r.u;
    EXPECT_NEAR(road.line.curvature(r.u, r.v), r.curvature, 1e-6) << r.u << " " << r.v;
  }
  std::printf("[ figure ] %s: %zu rows, place %.3g m, height %.3g m\n", GetParam(), rows.size(),
              place_error, height_error);
}

INSTANTIATE_TEST_SUITE_P(Roads, CrgReference,
                         testing::Values("straight_bumps", "curved", "banked_sloped"),
                         [](const auto& file) { return std::string(file.param); });

/// z, zx, ... by central differences of the height and of the slopes.
void expect_derivatives(const CrgRoad& road, double x, double y) {
  const double h = 1e-5;
  const SurfacePoint s = crg_surface(road, x, y);
  const SurfacePoint e = crg_surface(road, x + h, y), w = crg_surface(road, x - h, y);
  const SurfacePoint n = crg_surface(road, x, y + h), o = crg_surface(road, x, y - h);
  EXPECT_NEAR(s.zx, (e.z - w.z) / (2.0 * h), 1e-8);
  EXPECT_NEAR(s.zy, (n.z - o.z) / (2.0 * h), 1e-8);
  EXPECT_NEAR(s.zxx, (e.zx - w.zx) / (2.0 * h), 1e-6);
  EXPECT_NEAR(s.zxy, (e.zy - w.zy) / (2.0 * h), 1e-6);
  EXPECT_NEAR(s.zxy, (n.zx - o.zx) / (2.0 * h), 1e-6);
  EXPECT_NEAR(s.zyy, (n.zy - o.zy) / (2.0 * h), 1e-6);
}

TEST(CrgRoad, DerivativesWithinCells) {
  for (const char* name : {"straight_bumps", "curved", "banked_sloped"})
    for (const CrgInterpolation kind : {CrgInterpolation::linear, CrgInterpolation::cubic})
      for (const CrgBorder border : {CrgBorder::keep, CrgBorder::repeat, CrgBorder::reflect}) {
        CrgRoad road = read_crg(std::filesystem::path(folder + name + ".crg"));
        road.interpolation = kind;
        road.edge_u.mode = road.edge_v.mode = border;
        const double u0 = road.line.first();
        for (int k = 0; k < 60; ++k) {
          // In the middle third of a cell, within and outside of the grid.
          const double u = u0 + 0.5 * (k - 8) + 0.17 + 0.17 * ((k * 7) % 5) / 4.0;
          const double v = -3.0 + 0.5 * ((k * 5) % 13) + 0.17;
          const ReferenceLine::Node p = road.line.place(u, v);
          expect_derivatives(road, p.x, p.y);
        }
      }
}

TEST(CrgRoad, CubicSlopesDoNotJump) {
  CrgRoad road = read_crg(std::filesystem::path(folder + "straight_bumps.crg"));
  road.interpolation = CrgInterpolation::cubic;
  double linear_jump = 0.0;
  for (int k = 1; k < 20; ++k)
    for (const double v : {-1.5, -1.0, -0.2, 0.5, 1.2}) {
      const double u = road.line.first() + 0.5 * k, e = 1e-9;
      const CrgHeight a = crg_height(road, u - e, v), b = crg_height(road, u + e, v);
      EXPECT_NEAR(a.zu, b.zu, 1e-7);
      EXPECT_NEAR(a.zv, b.zv, 1e-7);
      road.interpolation = CrgInterpolation::linear;
      linear_jump = std::max(
          linear_jump, std::abs(crg_height(road, u - e, v).zu - crg_height(road, u + e, v).zu));
      road.interpolation = CrgInterpolation::cubic;
      EXPECT_NEAR(crg_height(road, u, -1.5 + 0.5 * (k % 7)).z,
                  road.grid(static_cast<std::size_t>(k), static_cast<std::size_t>(k % 7)), 1e-14);
    }
  EXPECT_GT(linear_jump, 0.01);
}

/// What was asked before does not matter, bit for bit, and nothing is far from any place.
TEST(CrgRoad, DoesNotRemember) {
  const CrgRoad road = read_crg(std::filesystem::path(folder + "curved.crg"));
  std::vector<SurfacePoint> first;
  const auto place = [](int k) { return std::array{-20.0 + 0.61 * k, 15.0 - 0.37 * k}; };
  for (int k = 0; k < 100; ++k) first.push_back(crg_surface(road, place(k)[0], place(k)[1]));
  for (int k = 100; k-- > 0;) {
    const SurfacePoint again = crg_surface(road, place(k)[0], place(k)[1]);
    EXPECT_EQ(again.z, first[static_cast<std::size_t>(k)].z);
    EXPECT_EQ(again.zxy, first[static_cast<std::size_t>(k)].zxy);
  }
}

TEST(CrgRoad, BeginsAtTheOrigin) {
  const CrgRoad road = read_crg(std::filesystem::path(folder + "banked_sloped.crg"));
  CrgRoad moved = road;
  begin_at_origin(moved);
  const ReferenceLine::Node start = moved.line.place(0.0, 0.0), ahead = moved.line.place(1.0, 0.0);
  EXPECT_NEAR(start.x, 0.0, 1e-14);
  EXPECT_NEAR(start.y, 0.0, 1e-14);
  EXPECT_NEAR(ahead.x, 1.0, 1e-8);
  EXPECT_NEAR(ahead.y, 0.0, 1e-8);
  const double z0 = 1.5, c = std::cos(0.2), s = std::sin(0.2);
  for (int k = 0; k < 40; ++k) {
    const double x = 0.47 * k, y = 0.13 * (k % 7 - 3);
    EXPECT_NEAR(crg_surface(moved, x, y).z, crg_surface(road, c * x - s * y, s * x + c * y).z - z0,
                1e-10);
  }
}

/// A closed circle of radius 20 m: the height is that of the grid across the seam as well.
TEST(CrgRoad, ClosedCircle) {
  const int n = 400;
  const double turn = 2.0 * 3.14159265358979323846, R = 20.0,
               step = 2.0 * R * std::sin(turn / n / 2);
  std::string text =
      "$CT\n$\n$ROAD_CRG\nREFERENCE_LINE_INCREMENT = " + std::to_string(step) + "\n" +
      "LONG_SECTION_V_INCREMENT = 2.0\n$\n$KD_DEFINITION\n#:LDFI\nD:reference line phi,rad\n"
      "D:long section 1,m\nD:long section 2,m\n$\n$$\n";
  // The step of the header has six digits, so it closes to 400 times 5e-7 m.
  for (int k = 0; k <= n; ++k) {
    char line[128];
    const double z = 0.1 * std::sin(turn * k / n);
    std::snprintf(line, sizeof line, "%20.14f%20.14f%20.14f\n", turn * (k - 0.5) / n, z, z);
    text += line;
  }
  const CrgRoad road = read_crg(text, "circle.crg");
  EXPECT_TRUE(road.line.closed());
  for (int k = 0; k < 1000; ++k) {
    const double a = turn * k / 1000.0, r = R + 0.5 * std::sin(7.0 * a);
    EXPECT_NEAR(crg_surface(road, r * std::sin(a), R - r * std::cos(a)).z, 0.1 * std::sin(a), 2e-5)
        << k;
  }
}

}  // namespace
}  // namespace floatframe::test
