#include "floatframe/page/check_page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "floatframe/core/build_info.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/output_list.hpp"
#include "floatframe/page/page_json.hpp"
#include "floatframe/page/scene_json.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

std::string body_at(const Model& model, int marker) {
  return marker < 0 ? "" : body_name(model, marker);
}

/// Each joint with its bodies and the direction of its axis in the design configuration.
Json joint_table(const Model& model) {
  Json rows = Json::array();
  for (const Joint& j : model.joints) {
    if (j.automatic) continue;
    const Marker& F = model.markers[j.frame_F];
    const Mat3 R_WB = F.body < 0 ? Mat3::Identity() : model.bodies[F.body].X_WB.R;
    const Vec3 z = R_WB * F.X_NM.R.col(2);
    const auto direction = [](double x) { return std::abs(x) < 5e-5 ? 0.0 : x; };
    rows.push_back(
        {j.name, joint_type_name(j.type), body_at(model, j.frame_F), body_at(model, j.frame_M),
         fmt::format("{:.4g}, {:.4g}, {:.4g}", direction(z[0]), direction(z[1]), direction(z[2])),
         j.cut ? "cut" : ""});
  }
  return {{"heading", "Joints"},
          {"columns", {"joint", "type", "parent", "child", "axis in the design", ""}},
          {"rows", std::move(rows)}};
}

Json force_table(const Model& model) {
  Json rows = Json::array();
  for (const Element& e : model.elements)
    if (e.exerts())
      rows.push_back({e.name, element_type_name(e.type),
                      body_at(model, e.markers.size() > 1 ? e.markers.front() : -1),
                      body_at(model, e.markers.back())});
  return {{"heading", "Forces"}, {"columns", {"force", "type", "from", "to"}}, {"rows", rows}};
}

}  // namespace

void require_page(const std::string& option) {
  if (!page_template().empty()) return;
  throw InputError(
      ErrorCode::unavailable,
      option +
          ": this program was built without the page; build it with Node 18 or later and npm, or "
          "from a release archive, which holds the page");
}

std::string check_page(const Model& model, const CheckedStart& start) {
  PageBuffer buffer;
  Json sentences = Json::array();
  if (start.failure.empty()) {
    sentences.push_back("The model in the configuration that a run starts from.");
  } else {
    sentences.push_back("A run of this model cannot start: " + start.failure);
    sentences.push_back("Shown is the design configuration, where the model file puts the bodies.");
  }
  for (const std::string& note : start.notes) sentences.push_back(note);
  Json tables = tables_json(start.tables);
  tables.push_back(joint_table(model));
  tables.push_back(force_table(model));
  Json page = empty_page("check", model.name, build_description(),
                         {{"state", start.failure.empty() ? "completed" : "failed"},
                          {"sentences", sentences},
                          {"warnings", Json::array()}});
  page["facts"] = facts_json(start.facts);
  page["tables"] = std::move(tables);
  SceneFrames frames = scene_frames(model, start.state);
  frames.efforts = start.efforts;
  page["scene"] = scene_json(model, frames, buffer);
  return page_html(page_template(), page, buffer);
}

}  // namespace floatframe
