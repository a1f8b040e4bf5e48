// The page of a validation: HTML and SVG alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/description/rules.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/page/html_text.hpp"
#include "floatframe/page/page_curves.hpp"
#include "floatframe/page/plot_ticks.hpp"
#include "floatframe/page/scene_json.hpp"
#include "floatframe/page/scene_mesh.hpp"
#include "floatframe/validation/benchmark_report.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;
using Vec2 = Eigen::Vector2d;

constexpr const char* validation_head = R"html(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="generator" content="Floatframe">
<meta name="viewport" content="width=device-width"><title>Validation</title><style>
body, svg text { font: 15px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
body { color: #1c2126; margin: 2em auto; max-width: 72em; padding: 0 1em; }
table { border-collapse: collapse; }
td, th { padding: .15em .8em .15em 0; text-align: left; border-bottom: 1px solid #e8ebef; }
td.n { text-align: right; font-variant-numeric: tabular-nums; }
.beyond { color: #b3261e; font-weight: 600; } .source, figcaption { color: #59636e; }
section { margin-top: 2.5em; } .pictures { display: flex; flex-wrap: wrap; gap: 1.5em; }
figure { margin: 0; } svg text { font-size: 12px; fill: #59636e; } .grid { stroke: #e8ebef; }
.c0, .c1 { fill: none; stroke: #0072b2; stroke-width: 1.6; }
.c1 { stroke: #d55e00; stroke-dasharray: 7 4; } .dot { fill: none; stroke: #1c2126; }
.body { stroke: #0072b2; stroke-width: 2; fill: #0072b2; fill-opacity: .12; }
.mesh { stroke: #0072b2; stroke-width: .4; fill: none; } .before { opacity: .3; }
.joint { fill: #fff; stroke: #1c2126; stroke-width: 1.4; }
.force { stroke: #008a64; stroke-width: 1.6; stroke-dasharray: 3 3; }
.rod { stroke: #1c2126; stroke-width: 1.6; }
.guide { fill: none; stroke: #4f9a7f; stroke-width: 1.2; }
</style></head><body>
)html";

/// Where the picture shows a point of the world: planar mechanisms in their plane, others from a
/// corner.
struct View {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY();
  Vec2 low = Vec2::Constant(1e300), high = -low;
  double scale = 1.0;
  static constexpr double width = 340.0, height = 260.0, margin = 14.0;

  Vec2 flat(const Vec3& p) const { return {right.dot(p), up.dot(p)}; }
  Vec2 operator()(const Vec3& p) const {
    const Vec2 x = scale * (flat(p) - 0.5 * (low + high));
    return {0.5 * width + x[0], 0.5 * height - x[1]};
  }
  void fit(const std::vector<Vec3>& points, const Vec3& upwards) {
    Vec3 least = Vec3::Constant(1e300), most = -least;
    for (const Vec3& p : points) least = least.cwiseMin(p), most = most.cwiseMax(p);
    const Vec3 extent = most - least;
    Eigen::Index across = 0;
    extent.minCoeff(&across);
    if (extent[across] <= 0.02 * extent.maxCoeff()) {
      right = across == 0 ? Vec3::UnitY() : Vec3::UnitX();
      up = across == 2 ? Vec3::UnitY() : Vec3::UnitZ();
    } else {
      const Vec3 a = std::abs(upwards[2]) > 0.5 ? Vec3::UnitX() : Vec3::UnitZ();
      const Vec3 towards = (0.5 * a - 0.85 * upwards.cross(a) + 0.45 * upwards).normalized();
      right = upwards.cross(towards).normalized();
      up = towards.cross(right);
    }
    for (const Vec3& p : points) low = low.cwiseMin(flat(p)), high = high.cwiseMax(flat(p));
    const Vec2 size = (high - low).cwiseMax(Vec2::Constant(1e-12));
    scale = std::min((width - 2 * margin) / size[0], (height - 2 * margin) / size[1]);
  }
};

/// A model in one state: the points that joints, forces and rods hold to, by the bodies.
class Pose {
 public:
  Pose(const Model& model, const SystemState& state)
      : model_(model), frames_(scene_frames(model, state)) {
    PageBuffer unused;
    scene_ = scene_json(model, frames_, unused);
    for (const Json& p : scene_["points"]) points_.push_back(place(p["body"], vector(p["p"])));
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
      const FlexibleBody& data = *model.bodies[b].data;
      std::vector<Vec3> mine;
      for (std::size_t k = 0; k < points_.size(); ++k)
        if (scene_["points"][k]["body"] == static_cast<int>(b)) mine.push_back(points_[k]);
      if (data.invariants.m > 0.0 && mine.size() < 2)
        mine.push_back(place(static_cast<int>(b), data.invariants.m_u / data.invariants.m));
      bodies_.push_back(std::move(mine));
    }
    for (const Element& e : model.elements)
      for (const Stroke& s : strokes_of(model, e)) strokes_.push_back(placed(s));
  }

  void add_points(std::vector<Vec3>& out) const {
    for (const Line& s : strokes_) out.insert(out.end(), s.begin(), s.end());
    out.insert(out.end(), points_.begin(), points_.end());
    for (const auto& body : bodies_) out.insert(out.end(), body.begin(), body.end());
  }

  std::string svg(const View& view) const {
    std::string out;
    for (std::size_t b = 0; b < bodies_.size(); ++b) out += mesh(b, view) + outline(b, view);
    for (const Line& s : strokes_) out += path("guide", s, view);
    for (const Json& f : scene_["forces"]) out += line("force", f, view);
    for (const Json& r : scene_["rods"]) out += line("rod", r, view);
    for (const Json& j : scene_["joints"])
      for (const char* end : {"a", "b"})
        if (const int k = j[end]; k >= 0)
          out += fmt::format("<circle class=\"joint\" r=\"3.5\" cx=\"{:.1f}\" cy=\"{:.1f}\"/>\n",
                             view(points_[k])[0], view(points_[k])[1]);
    return out;
  }

 private:
  using Line = std::vector<Vec3>;

  Line placed(const Stroke& s) const {
    const Marker& m = model_.markers[s.marker];
    Vec3 at = m.X_NM.p;
    if (m.body >= 0 && m.node >= 0) at += model_.bodies[m.body].data->nodes[m.node].p;
    Line out;
    for (const Vec3& p : s.points) out.push_back(place(m.body, at + m.X_NM.R * p));
    return out;
  }

  static std::string path(const char* kind, const Line& points, const View& view) {
    std::string d;
    for (const Vec3& p : points)
      d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : "L", view(p)[0], view(p)[1]);
    return fmt::format("<path class=\"{}\" d=\"{}\"/>\n", kind, d);
  }

  static Vec3 vector(const Json& p) {
    return Vec3(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
  }

  Vec3 place(int body, const Vec3& p) const {
    if (body < 0) return p;
    const double* x = frames_.pose(0, static_cast<std::size_t>(body));
    return Vec3(x[0], x[1], x[2]) + Eigen::Quaterniond(x[6], x[3], x[4], x[5]) * p;
  }

  std::string line(const char* kind, const Json& of, const View& view) const {
    const int a = of["a"], b = of["b"];
    if (a < 0 || b < 0) return "";
    const Vec2 p = view(points_[a]), q = view(points_[b]);
    return fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"/>\n", kind, p[0],
                       p[1], q[0], q[1]);
  }

  /// The points of a body, about their centre.
  std::string outline(std::size_t body, const View& view) const {
    std::vector<Vec2> at;
    Vec2 centre = Vec2::Zero();
    for (const Vec3& p : bodies_[body]) centre += at.emplace_back(view(p));
    if (at.empty()) return "";
    if (at.size() == 1)
      return fmt::format("<circle class=\"body\" r=\"6\" cx=\"{:.1f}\" cy=\"{:.1f}\"/>\n", at[0][0],
                         at[0][1]);
    centre /= static_cast<double>(at.size());
    std::ranges::sort(
        at, {}, [&](const Vec2& p) { return std::atan2(p[1] - centre[1], p[0] - centre[0]); });
    std::string path;
    for (const Vec2& p : at)
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p[0], p[1]);
    return fmt::format("<path class=\"body\" d=\"{}Z\"/>\n", path);
  }

  std::string mesh(std::size_t body, const View& view) const {
    const SceneMesh m = scene_mesh(*model_.bodies[body].data);
    constexpr std::size_t most = 4000;
    std::string path;
    for (std::size_t t = 0; t + 2 < std::min(m.triangles.size(), 3 * most); t += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const float* v = m.vertices.data() + 3 * m.triangles[t + k];
        const Vec2 p = view(place(static_cast<int>(body), Vec3(v[0], v[1], v[2])));
        path += fmt::format("{}{:.1f} {:.1f}{}", k == 0 ? "M" : "L", p[0], p[1], k == 2 ? "Z" : "");
      }
    return path.empty() ? "" : fmt::format("<path class=\"mesh\" d=\"{}\"/>\n", path);
  }

  const Model& model_;
  SceneFrames frames_;
  Json scene_;
  std::vector<Vec3> points_;
  std::vector<std::vector<Vec3>> bodies_;
  std::vector<Line> strokes_;
};

std::string picture(const Model& model, const BenchmarkResult* run) {
  const SystemState design;
  const Pose now(model, run && run->start ? *run->start : design);
  const Pose later(model, run && run->end ? *run->end : design);
  std::vector<Vec3> points;
  now.add_points(points);
  later.add_points(points);
  if (points.empty()) return "";
  View view;
  view.fit(points, scene_up(model));
  return fmt::format(
      "<figure><svg width=\"{0:g}\" height=\"{1:g}\" role=\"img\"><g>\n{2}</g><g "
      "class=\"before\">\n"
      "{3}</g></svg><figcaption>At the start, and pale at the end</figcaption></figure>\n",
      View::width, View::height, now.svg(view), later.svg(view));
}

/// One output over the time in all formulations, and the reference.
class OutputPlot {
 public:
  OutputPlot(const ValidatedBenchmark& v, const BenchmarkCheck& check) : v_(v), check_(check) {
    std::vector<double> all;
    for (const BenchmarkResult& r : v.results) {
      Curve c;
      const PageCurves curves =
          page_curves(r.table.columns, r.table.rows(), 800, [&](auto row, double* out) {
            std::copy_n(r.table.data.data() + row * r.table.columns.size(), r.table.columns.size(),
                        out);
          });
      for (std::size_t k = 0; k < curves.values.size(); ++k)
        if (curves.columns[k + 1].name == check.output) {
          c = {curves.time, curves.values[k]};
          unit_ = curves.columns[k + 1].unit;
        }
      all.insert(all.end(), c.y.begin(), c.y.end());
      if (!c.x.empty()) end_ = std::max(end_, c.x.back());
      curves_.push_back(std::move(c));
    }
    for (const TablePoint& p : check.reference) all.push_back(p.f), end_ = std::max(end_, p.x);
    range_ = extent_of(all);
    if (!(range_.range() > 0.0)) range_.low -= 1.0, range_.high += 1.0;
  }

  std::string svg() const {
    std::string out =
        fmt::format("<figure><svg width=\"{:g}\" height=\"{:g}\" role=\"img\">\n", width, height);
    const Ticks tx = nice_ticks(0.0, end_, 6), ty = nice_ticks(range_.low, range_.high, 5);
    for (int k = 0; k < tx.count; ++k)
      out += fmt::format(
          "<path class=\"grid\" d=\"M{0:.1f} {1:g}V{2:g}\"/><text x=\"{0:.1f}\" y=\"{3:g}\" "
          "text-anchor=\"middle\">{4:g}</text>\n",
          x(tx.at(k)), top, bottom, bottom + 16, tx.at(k));
    for (int k = 0; k < ty.count; ++k)
      out += fmt::format(
          "<path class=\"grid\" d=\"M{0:g} {1:.1f}H{2:g}\"/><text x=\"{3:g}\" y=\"{4:.1f}\" "
          "text-anchor=\"end\">{5:g}</text>\n",
          left, y(ty.at(k)), right, left - 6, y(ty.at(k)) + 4,
          std::abs(ty.at(k)) < 1e-9 * ty.step ? 0.0 : ty.at(k));
    for (std::size_t k = 0; k < curves_.size(); ++k) {
      std::string path;
      for (std::size_t i = 0; i < curves_[k].x.size(); ++i)
        path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", x(curves_[k].x[i]),
                            y(curves_[k].y[i]));
      out += fmt::format("<path class=\"c{}\" d=\"{}\"/>\n", k % 2, path);
    }
    const std::size_t every = (check_.reference.size() + 59) / 60;
    for (std::size_t k = 0; k < check_.reference.size(); k += every)
      out += fmt::format("<circle class=\"dot\" r=\"3\" cx=\"{:.1f}\" cy=\"{:.1f}\"/>\n",
                         x(check_.reference[k].x), y(check_.reference[k].f));
    std::string names;
    for (const BenchmarkResult& r : v_.results)
      names += (names.empty() ? "" : ", dashed ") +
               std::string(rules::coordinates[index_of(r.coordinates)]);
    return out + fmt::format(
                     "</svg><figcaption>{} [{}] over the time [s]: {} coordinates; circles: the "
                     "reference</figcaption></figure>\n",
                     html_escape(check_.output), html_escape(unit_), names);
  }

 private:
  struct Curve {
    std::vector<double> x, y;
  };
  static constexpr double width = 560, height = 260, left = 80, right = 548, top = 10, bottom = 232;
  double x(double t) const { return left + (end_ > 0.0 ? t / end_ : 0.0) * (right - left); }
  double y(double v) const { return bottom - (v - range_.low) / range_.range() * (bottom - top); }

  const ValidatedBenchmark& v_;
  const BenchmarkCheck& check_;
  std::vector<Curve> curves_;
  std::string unit_;
  Extent range_;
  double end_ = 0.0;
};

std::string table_row(const ValidationRow& row) {
  const CheckResult& c = *row.found;
  return fmt::format(
      "<tr{}><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{:.2g}</td><td "
      "class=\"n\">{:.2g}</td>"
      "<td>{}</td><td class=\"n\">{:.2g}</td><td class=\"n\">{}</td></tr>\n",
      c.passed() ? "" : " class=\"beyond\"", html_escape(row.of->benchmark.name),
      rules::coordinates[index_of(row.result->coordinates)], html_escape(row.check->quantity),
      c.error, c.tolerance, html_escape(c.unit), c.part(),
      row.first ? fmt::format("{:.2f}", row.result->seconds) : "");
}

std::string section(const ValidatedBenchmark& v) {
  std::string out = fmt::format(
      "<section><h2>{}</h2>\n<p>{}</p><p class=\"source\">{}</p>\n<div class=\"pictures\">\n",
      html_escape(v.benchmark.name), html_escape(v.benchmark.title),
      html_escape(v.benchmark.source));
  out += picture(*v.model, v.results.empty() ? nullptr : &v.results.front());
  const auto first = std::ranges::find_if(
      v.benchmark.checks, [](const BenchmarkCheck& c) { return !c.output.empty(); });
  if (first != v.benchmark.checks.end()) out += OutputPlot(v, *first).svg();
  out += "</div>\n";
  for (const BenchmarkResult& r : v.results)
    for (const std::string& w : r.warnings)
      out += fmt::format("<p>{}: {}</p>\n", rules::coordinates[index_of(r.coordinates)],
                         html_escape(w));
  return out + "</section>\n";
}

}  // namespace

std::string validation_page(const std::vector<ValidatedBenchmark>& list,
                            const std::string& software) {
  std::string out = validation_head;
  out += fmt::format("<h1>Validation</h1>\n<p>{}. {}</p>\n", html_escape(validation_verdict(list)),
                     html_escape(software));
  for (const std::string& failure : validation_failures(list))
    out += fmt::format("<p class=\"beyond\">{}</p>\n", html_escape(failure));
  out +=
      "<table><tr><th>case</th><th>coordinates</th><th>quantity</th><th>error</th><th>tolerance</"
      "th>"
      "<th>unit</th><th>error/tolerance</th><th>time [s]</th></tr>\n";
  for (const ValidationRow& row : validation_rows(list)) out += table_row(row);
  out += "</table>\n";
  for (const ValidatedBenchmark& v : list) out += section(v);
  return out + "</body></html>\n";
}

}  // namespace floatframe
