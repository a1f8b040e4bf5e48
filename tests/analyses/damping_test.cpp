// What `check` and `modes` say of the damping of bodies and of the model, and the keys that give a
// mounted part, and a loaded one, the fraction that is asked for.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/model_file/load_model.hpp"
#include "support/error_of.hpp"
#include "support/model_text.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {
namespace {

using Json = nlohmann::json;

/// A cantilever of 200 x 20 x 10 mm with a mass of 0.1 kg at its tip, in mm-t-s.
std::string deck() {
  constexpr int nx = 20, ny = 2, nz = 1;
  std::string text = "*NODE\n", foot, tip, elements;
  const auto at = [&](int i, int j, int k) { return 1 + i + (nx + 1) * (j + (ny + 1) * k); };
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) {
        text += fmt::format("{}, {}., {}., {}.\n", at(i, j, k), 10 * i, 10 * j - 10, 10 * k - 5);
        if (i == 0) foot += fmt::format("{}\n", at(i, j, k));
        if (i == nx) tip += fmt::format("{}\n", at(i, j, k));
      }
  int element = 0;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      elements += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", ++element, at(i, j, 0),
                              at(i + 1, j, 0), at(i + 1, j + 1, 0), at(i, j + 1, 0), at(i, j, 1),
                              at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1));
  return text + "9001, 200., 0., 0.\n*ELEMENT, TYPE=C3D8I, ELSET=E\n" + elements +
         "*ELEMENT, TYPE=MASS, ELSET=PM\n9000, 9001\n*MASS, ELSET=PM\n1.E-4\n*NSET, NSET=FOOT\n" +
         foot + "*NSET, NSET=TIP\n" + tip +
         "*MATERIAL, NAME=ST\n*ELASTIC\n210000., 0.3\n*DENSITY\n7.85E-9\n"
         "*SOLID SECTION, ELSET=E, MATERIAL=ST\n*RIGID BODY, NSET=TIP, REF NODE=9001\n";
}

std::string on_its_foot(const std::string& damping) {
  return "floatframe: 1\ngravity: [0, 0, 0]\nbodies:\n"
         "  foot: {rigid: {mass: 1, centre_of_mass: [0, 0, 0]}}\n"
         "  beam:\n"
         "    flexible: {file: beam.inp, units: mm-t-s, dialect: calculix, modes: 10,\n"
         "      interfaces: {FOOT: {set: FOOT}}, markers: {TIP: {node: 9001}},\n"
         "      damping: " +
         damping +
         "}\n"
         "joints:\n"
         "  rail: {type: prismatic, child: foot, at: [0, 0, 0], axis: z, motion: 0}\n"
         "  w: {type: weld, parent: foot, child: beam, child_node: FOOT}\n";
}

std::string loaded_bar(const std::string& damping) {
  return "gravity: [0, 0, 0]\npoints: {o: [0, 0, 0], t: [1, 0, 0]}\nbodies:\n"
         "  b: {flexible: {material: {young: 2.1e11, poisson: 0.3, density: 7850}, bars: {b: {\n"
         "    from: o, to: t, elements: 10, section: {round: 0.02}}}, clamped: [o],\n"
         "    static_modes: [{point: t, dofs: [y, z]}], normal_modes: 4, damping: " +
         damping +
         "}}\n"
         "  m: {rigid: {mass: 20, centre_of_mass: t}}\n"
         "joints: {w: {type: weld, child: b, at: o}, t: {type: weld, parent: b, child: m, at: "
         "t}}\n";
}

/// Of the first vibrations of a model.
double fraction(const Json& modes, std::size_t k) { return modes["modes"][k]["damping_ratio"]; }
double frequency(const Json& modes, std::size_t k) { return modes["modes"][k]["frequency_Hz"]; }

TEST(Damping, OfAPartOnItsFoot) {
  const TemporaryFolder folder;
  folder.write("beam.inp", deck());
  const auto model = [&](const std::string& damping) {
    return load_model(folder.write("model.yaml", on_its_foot(damping)));
  };
  const auto free = Json::parse(modes_analysis().run(model("0.02")).json);
  EXPECT_NEAR(fraction(free, 0), 0.0013, 3e-4);  // 2 % belong to the modes of the free part
  const Json& own = free["body_damping"][0];
  EXPECT_EQ(own["bodies"], Json::array({"beam"}));
  EXPECT_NEAR(own["free"][0]["fraction"], 0.02, 1e-8);
  EXPECT_NEAR(own["mounted"][0]["fraction"].get<double>() / fraction(free, 0), 1.0, 1e-5);
  EXPECT_NEAR(own["mounted"][0]["frequency_Hz"].get<double>() / frequency(free, 0), 1.0, 1e-5);
  // As mounted: another key of the cache, another body.
  const Model mounted = model("{fraction: 0.02, reference: mounted}");
  const auto modes = modes_analysis().run(mounted);
  const auto json = Json::parse(modes.json);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(fraction(json, k), 0.02, 1e-6);
  EXPECT_NE(modes.text.find("damping of beam, fractions of critical [%] of its own modes"),
            std::string::npos)
      << modes.text;
  const std::string text = check_analysis().run(mounted).text;
  EXPECT_NE(text.find("mounted [Hz]"), std::string::npos) << text;
  EXPECT_NE(text.find("damping of the model's first vibrations as it starts: "), std::string::npos)
      << text;
  EXPECT_NE(text.find(" Hz 2 %"), std::string::npos) << text;
}

// The mass of another body decides the frequency, and so the fraction, of what the static modes do.
TEST(Damping, OfALoadedBar) {
  const auto modes = [&](const std::string& damping) {
    return Json::parse(modes_analysis().run(model_of(loaded_bar(damping))).json);
  };
  const Json plain = modes("0.02");
  EXPECT_NEAR(fraction(plain, 0), 0.0033, 1e-4);
  EXPECT_NEAR(plain["body_damping"][0]["frame"][0]["fraction"], 0.02, 1e-9);
  EXPECT_LT(fraction(modes("{fraction: 0.02, reference: mounted}"), 0), 0.005);
  const Json at = modes(
      fmt::format("{{fraction: 0.02, reference: mounted, frequency: {}}}", frequency(plain, 0)));
  for (const std::size_t k : {0u, 1u}) EXPECT_NEAR(fraction(at, k), 0.02, 1e-4);
  const Json stiff =
      modes(fmt::format("{{rayleigh: [0, {}]}}", 0.02 / (3.141592653589793 * frequency(plain, 0))));
  EXPECT_NEAR(fraction(stiff, 0), 0.02, 1e-6);
  EXPECT_EQ(Json::parse(modes_analysis().run(model_of(loaded_bar("0"))).json)["body_damping"],
            Json::array());
}

TEST(Damping, OfAModelFileNamesThePlace) {
  const auto error = [](const std::string& damping) {
    const std::string text = error_of([&] { model_of(loaded_bar(damping)); });
    const std::size_t at = text.find("bodies.b");
    return at == std::string::npos ? text : text.substr(at);
  };
  const std::string key = "bodies.b.flexible.damping";
  EXPECT_EQ(error("{fraction: 2}"), key + ".fraction: out_of_range");
  EXPECT_EQ(error("{fractions: [0.1, -1]}"), key + ".fractions[2]: out_of_range");
  EXPECT_EQ(error("{bands: [[100, 0.01], [50, 0.1], 1]}"), key + ": out_of_range");
  EXPECT_EQ(error("{bands: [[100, 0.01]]}"), key + ": out_of_range");
  EXPECT_EQ(error("{bands: adams}"), key + ".bands: wrong_value");
  EXPECT_EQ(error("{fraction: 0.1, rayleigh: [1, 0]}"), key + ": exclusive");
  EXPECT_EQ(error("{fraction: 0.1, reference: mount}").substr(0, key.size() + 30),
            key + ".reference: wrong_value");
  EXPECT_EQ(error("{fraction: 0.1, frequency: 3}"), key + ": out_of_range");
  EXPECT_EQ(test::without_folders(error("{fractions: [0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1]}")),
            "model.yaml:5:17: wrong_count");
}

// Eight equal bars on a star: static modes turn the ends about the bars, which have no inertia.
TEST(Damping, EqualBarsWithoutInertiaOfSectionsNameTheRemedy) {
  std::string points = "points: {c: [0, 0, 0]", bars, statics, joints;
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.7853981633974483 * k;
    points += fmt::format(", e{}: [{}, {}, 0]", k, 5.0 * std::cos(angle), 5.0 * std::sin(angle));
    bars += fmt::format(
        "{}b{}: {{from: c, to: e{}, elements: 8, section: {{rectangle: [0.125, 0.125]}}}}",
        k > 0 ? ", " : "", k, k);
    statics += fmt::format("{}e{}", k > 0 ? ", " : "", k);
    joints += fmt::format("  p{0}: {{type: revolute, child: x, at: e{0}, axis: z}}\n", k);
  }
  const auto cross = [&](const std::string& more) {
    return points +
           "}\nbodies:\n  x: {flexible: {material: {young: 2e11, poisson: 0.3, density: "
           "8000}, bars: {" +
           bars + "}, clamped: [c], static_modes: [" + statics +
           "], normal_modes: 60, mass_model: hermite" + more + "}}\njoints:\n" + joints;
  };
  const std::string error = error_of([&] { model_of(cross("")); });
  EXPECT_EQ(test::without_folders(error), "model.yaml:4:17: wrong_value") << error;
  EXPECT_EQ(error.find("Tridiag"), std::string::npos) << error;
  EXPECT_EQ(model_of(cross(", section_inertia: true")).bodies[0].modes(), 108);
}

}  // namespace
}  // namespace floatframe::test
