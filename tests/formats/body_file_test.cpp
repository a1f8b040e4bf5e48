// Body files: what is written is read again to the bit; every damage is one error.
#include "floatframe/formats/body_file/body_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/core/atomic_file.hpp"
#include "floatframe/formats/body_file/body_arrays.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/formats/body_file/npy.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"
#include "formats/bracket_file.hpp"
#include "support/error_of.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe {
namespace {

void expect_equal_stress(const BodyStress* a, const BodyStress* b) {
  ASSERT_EQ(a != nullptr, b != nullptr);
  if (!a) return;
  EXPECT_EQ(a->modes, b->modes);
  EXPECT_EQ(a->loads, b->loads);
  EXPECT_EQ(a->section_modes, b->section_modes);
  EXPECT_EQ(a->section_loads, b->section_loads);
  EXPECT_EQ(a->first_place, b->first_place);
  ASSERT_EQ(a->groups.size(), b->groups.size());
  for (std::size_t k = 0; k < a->groups.size(); ++k) {
    EXPECT_EQ(a->groups[k].name, b->groups[k].name);
    EXPECT_EQ(a->groups[k].young, b->groups[k].young);
    EXPECT_EQ(a->groups[k].poisson, b->groups[k].poisson);
  }
  ASSERT_EQ(a->places.size(), b->places.size());
  for (std::size_t k = 0; k < a->places.size(); ++k) {
    const StressPlace &p = a->places[k], &q = b->places[k];
    EXPECT_EQ(std::tie(p.layer, p.point, p.node, p.number, p.group, p.doubtful),
              std::tie(q.layer, q.point, q.node, q.number, q.group, q.doubtful));
    EXPECT_EQ(p.p, q.p);
  }
  ASSERT_EQ(a->sections.size(), b->sections.size());
  for (std::size_t k = 0; k < a->sections.size(); ++k) {
    EXPECT_EQ(a->sections[k].p, b->sections[k].p);
    const BeamSectionPlace &p = a->sections[k], &q = b->sections[k];
    EXPECT_EQ(std::tie(p.element, p.node, p.number, p.end, p.name),
              std::tie(q.element, q.node, q.number, q.end, q.name));
  }
}

void expect_equal(const BodyFile& a, const BodyFile& b) {
  const InertiaInvariants &v = a.part.body.invariants, &w = b.part.body.invariants;
  EXPECT_EQ(v.m, w.m);
  EXPECT_EQ(v.m_u, w.m_u);
  EXPECT_EQ(v.P_u, w.P_u);
  EXPECT_EQ(v.S, w.S);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(v.Si[i], w.Si[i]);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(v.Sij[i][j], w.Sij[i][j]);
  }
  EXPECT_EQ(a.part.body.K, b.part.body.K);
  EXPECT_EQ(a.part.body.D, b.part.body.D);
  EXPECT_EQ(a.part.body.fixed_interface_frequencies, b.part.body.fixed_interface_frequencies);
  EXPECT_EQ(a.part.body.mode_names, b.part.body.mode_names);
  EXPECT_EQ(a.part.body.equal_left_out, b.part.body.equal_left_out);
  ASSERT_EQ(a.part.body.interfaces.size(), b.part.body.interfaces.size());
  for (std::size_t k = 0; k < a.part.body.interfaces.size(); ++k) {
    EXPECT_EQ(a.part.body.interfaces[k].node, b.part.body.interfaces[k].node);
    EXPECT_EQ(a.part.body.interfaces[k].mask, b.part.body.interfaces[k].mask);
  }
  ASSERT_EQ(a.part.health.damping.mounted.size(), b.part.health.damping.mounted.size());
  for (std::size_t k = 0; k < a.part.health.damping.mounted.size(); ++k)
    EXPECT_EQ(a.part.health.damping.mounted[k].fraction, b.part.health.damping.mounted[k].fraction);
  EXPECT_EQ(a.part.body.mass_model, b.part.body.mass_model);
  ASSERT_EQ(a.part.body.nodes.size(), b.part.body.nodes.size());
  for (std::size_t k = 0; k < a.part.body.nodes.size(); ++k) {
    const ModalNode &n = a.part.body.nodes[k], &m = b.part.body.nodes[k];
    EXPECT_EQ(n.name, m.name);
    EXPECT_EQ(n.p, m.p);
    EXPECT_EQ(n.X, m.X);
    EXPECT_EQ(n.X_theta, m.X_theta);
  }
  EXPECT_EQ(a.part.surface.nodes, b.part.surface.nodes);
  EXPECT_EQ(a.part.surface.triangles, b.part.surface.triangles);
  EXPECT_EQ(a.part.surface.lines, b.part.surface.lines);
  EXPECT_EQ(a.part.surface_positions, b.part.surface_positions);
  EXPECT_EQ(a.part.surface_modes, b.part.surface_modes);
  expect_equal_stress(a.part.body.stress.get(), b.part.body.stress.get());
  ASSERT_EQ(!a.part.body.projection, !b.part.body.projection);
  if (const auto p = a.part.body.projection) {
    const auto q = b.part.body.projection;
    EXPECT_EQ(p->p, q->p);
    EXPECT_EQ(p->X, q->X);
    EXPECT_EQ(p->X_theta, q->X_theta);
    EXPECT_EQ(MatX(p->M_s), MatX(q->M_s));
    EXPECT_EQ(MatX(p->M_6), MatX(q->M_6));
    EXPECT_EQ(p->h, q->h);
  }
  ASSERT_EQ(!a.part.body.second_order, !b.part.body.second_order);
  if (const auto s = a.part.body.second_order) {
    const auto t = b.part.body.second_order;
    EXPECT_TRUE(s->S2 == t->S2 && s->S2i == t->S2i);
    ASSERT_EQ(s->nodes.size(), t->nodes.size());
    for (std::size_t k = 0; k < s->nodes.size(); ++k) {
      EXPECT_EQ(s->nodes[k].node, t->nodes[k].node);
      EXPECT_TRUE(s->nodes[k].h == t->nodes[k].h && s->nodes[k].theta == t->nodes[k].theta);
    }
  }
  EXPECT_EQ(health_json(a.part.health), health_json(b.part.health));
  const Provenance &p = a.provenance, &q = b.provenance;
  EXPECT_EQ(std::tie(p.source, p.source_hash, p.units, p.options, p.date, p.version, p.files),
            std::tie(q.source, q.source_hash, q.units, q.options, q.date, q.version, q.files));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(BodyFile, RoundTripIsExact) {
  for (const MassModel model : {MassModel::isoparametric, MassModel::six_dof, MassModel::hermite}) {
    const BodyFile file = bracket(model);
    ASSERT_EQ(!file.part.body.projection, model == MassModel::hermite);
    expect_equal(file, read_body_bytes(body_file_bytes(file), "x"));
  }
}

TEST(BodyFile, RigidPartWithoutSurface) {
  BodyFile file;
  file.part.body.invariants = InertiaInvariants::rigid(2.0, {0.1, 0.0, 0.0}, Mat3::Identity());
  file.part.body.K = file.part.body.D = MatX::Zero(0, 0);
  file.part.surface_positions = Mat3X::Zero(3, 0);
  file.part.body.nodes = {{"tip", Vec3::Ones(), Mat3X::Zero(3, 0), Mat3X::Zero(3, 0)}};
  expect_equal(file, read_body_bytes(body_file_bytes(file), "x"));
  BodyFile soft = bracket();
  soft.part.surface = {};
  soft.part.surface_positions.resize(3, 0);
  soft.part.surface_modes.resize(0, 0);
  EXPECT_EQ(read_body_bytes(body_file_bytes(soft), "x").part.body.modes(), 5);
}

TEST(BodyFile, EqualContentsGiveEqualBytes) {
  const BodyFile file = bracket();
  const std::string bytes = body_file_bytes(file);
  EXPECT_EQ(bytes, body_file_bytes(file));
  EXPECT_EQ(bytes, body_file_bytes(read_body_bytes(bytes, "x")));
}

// Written by format version 1 of the program: files of users stay readable.
TEST(BodyFile, FileOfVersion1) {
  const std::filesystem::path path = FLOATFRAME_TEST_DATA "/body_files/bracket_v1.ffb";
  const BodyFile file = read_body_file(path);
  EXPECT_TRUE(is_body_file(path));
  EXPECT_EQ(file.part.body.modes(), 5);
  EXPECT_EQ(file.part.body.nodes.size(), 3u);
  EXPECT_EQ(file.part.body.nodes[2].name, "eye");
  EXPECT_TRUE(file.part.body.projection);
  EXPECT_NEAR(file.part.body.invariants.m, bracket().part.body.invariants.m, 1e-14);
  EXPECT_EQ(file.part.health.warnings.size(), 1u);
  // Written before there were displacements of second order.
  EXPECT_EQ(file.part.body.second_order, nullptr);
  EXPECT_EQ(file.part.body.projection->h.size(), 0);
}

TEST(BodyFile, ErrorsOfTheArchive) {
  const std::string good = body_file_bytes(bracket());
  EXPECT_EQ(error_of_bytes(""), "arm.ffb: wrong_file");
  EXPECT_EQ(error_of_bytes("*NODE\n1,0,0,0\n"), "arm.ffb: wrong_file");
  EXPECT_EQ(error_of_bytes(good.substr(0, good.size() / 2)), "arm.ffb: damaged");
  EXPECT_EQ(error_of_bytes(zip_archive({{"a.txt", "b"}})), "arm.ffb: wrong_file");
  EXPECT_EQ(error_of_bytes(zip_archive({{"K.npy", "b"}, {"K.npy", "b"}})), "arm.ffb: duplicate");
  std::string changed = good;
  const std::size_t at = changed.find("K.npy") + 200;
  changed[at] = static_cast<char>(changed[at] ^ 1);
  EXPECT_EQ(error_of_bytes(changed), "arm.ffb: damaged") << error_of_bytes(changed);
  std::string compressed = good;  // of the first directory entry
  compressed[compressed.find("PK\1\2") + 10] = 8;
  EXPECT_EQ(error_of_bytes(compressed), "arm.ffb: unsupported");
}

TEST(BodyFile, ErrorsOfTheHeader) {
  const std::string good = body_file_bytes(bracket());
  const std::string header = member(good, "header.json");
  const auto with = [&](const std::string& from, const std::string& to) {
    return error_of_bytes(with_member(good, "header.json", replaced(header, from, to)));
  };
  EXPECT_EQ(with("\"format_version\": 1", "\"format_version\": 2"), "arm.ffb: mismatch");
  const std::string not_ours = "arm.ffb: wrong_file";
  EXPECT_EQ(with("floatframe body", "something"), not_ours);
  EXPECT_EQ(with("{", "["), "arm.ffb: wrong_file");
  EXPECT_EQ(with("\"eye\"", "\"foot\""), "arm.ffb: contradiction");
  EXPECT_EQ(with("isoparametric", "lumped"), "arm.ffb: wrong_value");
  EXPECT_EQ(with("\"elements\": 4", "\"elements\": \"4\""), "arm.ffb: wrong_value");
}

TEST(BodyFile, ErrorsOfTheArrays) {
  const std::string good = body_file_bytes(bracket());
  const auto with = [&](const std::string& name, const std::string& content) {
    return error_of_bytes(with_member(good, name + ".npy", content));
  };
  const auto doubles = [](std::vector<std::size_t> shape, double x, double last) {
    std::size_t n = 1;
    for (const std::size_t k : shape) n *= k;
    std::vector<double> values(n, x);
    values.back() = last;
    return npy_bytes({shape, values});
  };
  EXPECT_EQ(with("S", ""), "arm.ffb: missing");
  EXPECT_EQ(with("S", doubles({3, 4}, 0, 0)), "arm.ffb: wrong_count");
  EXPECT_EQ(with("S", npy_bytes({{3, 5}, std::vector<std::int32_t>(15, 1)})),
            "arm.ffb: wrong_count");
  EXPECT_EQ(with("K", doubles({5, 5}, 0, std::numeric_limits<double>::quiet_NaN())),
            "arm.ffb: not_finite");
  std::vector<double> skew(25, 0.0);
  skew[1] = 2.0;
  EXPECT_EQ(with("K", npy_bytes({{5, 5}, skew})), "arm.ffb: wrong_value");
  EXPECT_EQ(with("S21", doubles({5, 5}, 1.0, 2.0)), "arm.ffb: wrong_value");
  EXPECT_EQ(with("m", npy_bytes({{}, std::vector<double>{-1.0}})), "arm.ffb: wrong_value");
  EXPECT_EQ(with("surface_triangles", npy_bytes({{1, 3}, std::vector<std::int32_t>{0, 1, 3}})),
            "arm.ffb: out_of_range");
  EXPECT_EQ(with("surface_lines", npy_bytes({{1, 3}, std::vector<std::int32_t>{0, 1, 2}})),
            "arm.ffb: wrong_count");
  EXPECT_EQ(with("projection_M_s_indptr", npy_bytes({{2}, std::vector<std::int64_t>{0, 0}})),
            "arm.ffb: wrong_count");
  EXPECT_EQ(with("D", "garbage"), "arm.ffb: wrong_file");
  EXPECT_EQ(with("D", replaced(member(good, "D.npy"), "<f8", ">f8")), "arm.ffb: wrong_value");
  EXPECT_EQ(with("D", replaced(member(good, "D.npy"), "(5, 5)", "(5, 6)")), "arm.ffb: wrong_count");
  EXPECT_EQ(with("D", replaced(member(good, "D.npy"), "'shape'", "'shap'")), "arm.ffb: damaged");
  // Two errors at once.
  EXPECT_EQ(error_of_bytes(with_member(with_member(good, "P_u.npy", ""), "D.npy", "")),
            "arm.ffb: missing\narm.ffb: missing");
}

/// Arrays of the right shape that no body has, or that are not those of the header.
TEST(BodyFile, NumbersThatContradictEachOther) {
  const BodyFile file = bracket();
  const std::string good = body_file_bytes(file);
  const InertiaInvariants& v = file.part.body.invariants;
  const auto with = [&](const std::string& name, const MatX& values) {
    const bool number = name == "m", list = name == "m_u";
    const NpyArray array = number ? NpyArray{{}, std::vector<double>{values(0, 0)}}
                           : list ? list_of(values)
                                  : array_of(values);
    return error_of_bytes(with_member(good, name + ".npy", npy_bytes(array)));
  };
  const auto number = [](double x) { return MatX::Constant(1, 1, x); };
  EXPECT_EQ(with("m", number(0.0)), "arm.ffb: wrong_value");
  const std::string mass = with("m", number(1000.0 * v.m));
  EXPECT_EQ(mass, "arm.ffb: contradiction\narm.ffb: contradiction") << mass;
  EXPECT_EQ(with("P_u", MatX::Zero(3, 3)), "arm.ffb: wrong_value");
  EXPECT_EQ(with("P_u", 1.01 * v.P_u), "arm.ffb: contradiction");
  EXPECT_EQ(with("m_u", MatX(0.99 * v.m_u)), "arm.ffb: wrong_value");
  EXPECT_EQ(with("K", MatX::Zero(5, 5)), "arm.ffb: wrong_value");
  EXPECT_EQ(with("K", -file.part.body.K), "arm.ffb: wrong_value");
  EXPECT_EQ(with("K", 2.0 * file.part.body.K), "arm.ffb: contradiction");
  EXPECT_EQ(with("S11", -v.Sij[0][0]), "arm.ffb: wrong_value");
  EXPECT_EQ(with("S", 10.0 * v.S), "arm.ffb: wrong_value");
  EXPECT_EQ(with("D", -file.part.body.D), "arm.ffb: wrong_value");
  const std::string header = member(good, "header.json");
  const auto with_header = [&](const std::string& from, const std::string& to) {
    return error_of_bytes(with_member(good, "header.json", replaced(header, from, to)));
  };
  EXPECT_EQ(with_header("\"SI (m, kg, s, rad)\"", "\"mm\""), "arm.ffb: wrong_value");
  EXPECT_EQ(with_header("\"mass_kg\": 1.3964", "\"mass_kg\": 2.3964").substr(0, 78),
            "arm.ffb: contradiction");
  EXPECT_EQ(with_header("\"modes\": 5", "\"modes\": 6"), "arm.ffb: wrong_count");
}

/// Of a part whose nodes have rotary inertia, or of an earlier program, only M(0) is checked.
TEST(BodyFile, IntegralsOfRotaryInertia) {
  BodyFile file = bracket();
  InertiaInvariants& v = file.part.body.invariants;
  v.Sij[0][1] *= 3.0;  // no distribution of mass, but in no term at zero deformation
  v.Sij[1][0] *= 3.0;
  for (const std::optional<bool> rotary : {std::optional<bool>(), std::optional(true)}) {
    file.part.health.rotary_inertia = rotary;
    EXPECT_EQ(error_of_bytes(body_file_bytes(file)), "no error");
  }
  file.part.health.rotary_inertia = false;
  EXPECT_EQ(error_of_bytes(body_file_bytes(file)), "arm.ffb: wrong_value");
  file.part.health.rotary_inertia = true;
  v.S *= 10.0;
  EXPECT_EQ(error_of_bytes(body_file_bytes(file)), "arm.ffb: wrong_value");
}

TEST(BodyFile, IsWrittenWhole) {
  const test::TemporaryFolder folder;
  const BodyFile file = bracket();
  write_body_file(folder / "a.ffb", file);
  expect_equal(file, read_body_file(folder / "a.ffb"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}),
            1);  // nothing else
  EXPECT_THROW(write_body_file("/nowhere/a.ffb", file), OutputError);
}

TEST(BodyFile, FilesThatCannotBeRead) {
  const auto error = [](const char* path) { return test::error_of([&] { read_body_file(path); }); };
  EXPECT_EQ(error("/nowhere/x.ffb"), "/nowhere/x.ffb: unreadable");
  EXPECT_EQ(error("/dev/null"), "/dev/null: unreadable");
}

TEST(BodyFile, NoDamageCrashesTheReader) {
  const std::string good = body_file_bytes(bracket());
  for (std::size_t n = 0; n < good.size(); n += 97)
    EXPECT_NE(error_of_bytes(good.substr(0, n)), "no error") << n;
  std::uint32_t seed = 1;
  for (int k = 0; k < 3000; ++k) {
    std::string bad = good;
    seed = 1664525u * seed + 1013904223u;
    // Half of the changes in the directory, where no checksum watches.
    const std::size_t range = k % 2 == 0 ? bad.size() : bad.size() / 8;
    const std::size_t at = bad.size() - 1 - seed % range;
    bad[at] = static_cast<char>(bad[at] ^ (1 << (seed >> 29)));
    error_of_bytes(bad);
  }
}

TEST(Health, JsonRoundTripAndText) {
  HealthReport h = bracket().part.health;
  h.interfaces[0].condition = std::numeric_limits<double>::infinity();
  const HealthReport again = health_from_json(health_json(h));
  EXPECT_TRUE(std::isnan(again.interfaces[0].condition));  // null in JSON
  EXPECT_EQ(health_json(again), health_json(h));
  const std::string text = health_text(h);
  for (const char* part :
       {"mass [kg]", "1.3964", "+0.2500", "sum of those kept", "foot", "a note", "static error"})
    EXPECT_TRUE(test::contains(text, part)) << part << '\n' << text;
  EXPECT_TRUE(
      test::contains(text, "WARNING: 1 thing to look at\n  ! the interface 'eye' has few nodes\n"));
  EXPECT_EQ(text.find("  ! "), text.rfind("  ! "));
  EXPECT_TRUE(text.ends_with("few nodes\n"));  // warnings last
}

}  // namespace
}  // namespace floatframe
