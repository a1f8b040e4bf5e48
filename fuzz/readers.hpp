#pragma once
// Every reader as a function on bytes: it gives a model or throws InputError, whatever the bytes
// are. Nothing is written and no file is read. A new reader is one function and one entry in the
// list, a folder of seeds corpus/NAME, and its name in CMakeLists.txt.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/decks/abaqus/read_abaqus.hpp"
#include "floatframe/decks/ansys/read_ansys.hpp"
#include "floatframe/decks/nastran/read_nastran.hpp"
#include "floatframe/decks/unv/read_unv.hpp"
#include "floatframe/fe/unit_system.hpp"
#include "floatframe/formats/body_file/body_file.hpp"
#include "floatframe/formats/body_file/npy.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"
#include "floatframe/formats/geometry/geometry_file.hpp"
#include "floatframe/formats/gmsh/read_gmsh.hpp"
#include "floatframe/formats/matrices/matrix_model.hpp"
#include "floatframe/formats/matrices/op4_file.hpp"
#include "floatframe/formats/matrices/read_dmig.hpp"
#include "floatframe/formats/matrices/read_matrices.hpp"
#include "floatframe/formats/nastran/nastran_cards.hpp"
#include "floatframe/formats/sid/sid_file.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/history/history_blocks.hpp"
#include "floatframe/history/state_history.hpp"
#include "floatframe/roads/crg_file.hpp"
#include "floatframe/tyres/magic_tyre.hpp"
#include "packets.hpp"

namespace floatframe::fuzz {

inline void use(FeModel model) { to_si(model, *find_unit_system("mm-t-s")); }

/// Texts of several files in one input, divided by lines "====".
inline std::vector<std::string> parts_of(std::string_view bytes, std::size_t count) {
  std::vector<std::string> parts;
  while (parts.size() + 1 < count) {
    const std::size_t at = bytes.find("\n====\n");
    parts.emplace_back(bytes.substr(0, at == std::string_view::npos ? at : at + 1));
    bytes.remove_prefix(at == std::string_view::npos ? bytes.size() : at + 6);
  }
  parts.emplace_back(bytes);
  return parts;
}

inline void text(std::string_view bytes) {
  TextSource source(decompressed(std::string(bytes), "fuzz"), "fuzz");
  std::string_view line;
  while (source.next(line)) {
  }
}

/// A few bytes may make many nodes; the fuzzers allow few, so that their memory is judged all the
/// same.
constexpr std::int64_t may_make = 2000;

inline void abaqus(std::string_view bytes) {
  TextSource source(std::string(bytes), "fuzz.inp");
  source.may_make(may_make);
  use(read_abaqus(source, {}));
}

inline void tir(std::string_view bytes) { magic_tyre(parse_tir(bytes, "fuzz.tir")); }

inline void ansys(std::string_view bytes) {
  TextSource source(std::string(bytes), "fuzz.cdb");
  use(read_ansys(source, {}));
}

/// Stiffness, mass, map, nodes as a deck or a table.
template <typename Read>
void matrices(std::string_view bytes, Read read) {
  const std::vector<std::string> parts = parts_of(bytes, 4);
  TextSource stiffness(parts[0], "K"), mass(parts[1], "M"), dofs(parts[2], "dofs"),
      nodes(parts[3], "nodes");
  nodes.may_make(may_make);
  FeModel model = looks_like_abaqus(parts[3]) ? read_abaqus(nodes, {}, DeckPart::nodes)
                                              : read_node_table(nodes);
  use(read(stiffness, mass, dofs, std::move(model)));
}

inline void calculix_matrices(std::string_view bytes) {
  matrices(bytes, [](TextSource& K, TextSource& M, TextSource& dofs, FeModel nodes) {
    return read_calculix_matrices(K, M, dofs, std::move(nodes));
  });
}

inline void abaqus_matrices(std::string_view bytes) {
  matrices(bytes, [](TextSource& K, TextSource& M, TextSource&, FeModel nodes) {
    return read_abaqus_matrices(K, M, nullptr, std::move(nodes));
  });
}

inline void matrix_market(std::string_view bytes) {
  matrices(bytes, [](TextSource& K, TextSource& M, TextSource& dofs, FeModel nodes) {
    return read_matrix_market(K, M, dofs, std::move(nodes));
  });
}

/// Surfaces of meshes without sections as shells.
inline FeReadOptions with_thickness() {
  FeReadOptions options;
  options.thicknesses = {{"", 1.0}, {"PLATE", 2.0}, {"RIB", 3.0}};
  return options;
}

inline void gmsh(std::string_view bytes) {
  use(parse_gmsh(bytes, "fuzz.msh", bytes.size() % 2 == 0 ? FeReadOptions() : with_thickness()));
}

inline void nastran(std::string_view bytes) {
  TextSource source(std::string(bytes), "fuzz.bdf");
  source.may_make(may_make);
  use(read_nastran(source, has_begin_bulk(bytes), {}));
}

inline void unv(std::string_view bytes) {
  TextSource source(std::string(bytes), "fuzz.unv");
  use(read_unv(source, bytes.size() % 2 == 0 ? FeReadOptions() : with_thickness()));
}

/// Matrices and nodes.
inline void dmig(std::string_view bytes) {
  const std::vector<std::string> parts = parts_of(bytes, 2);
  TextSource matrices(parts[0], "fuzz.pch"), nodes(parts[1], "fuzz.bdf");
  nodes.may_make(may_make);
  use(read_dmig(matrices, nullptr, read_nastran(nodes, false, {}, NastranPart::nodes)));
}

/// Matrices of OUTPUT4, text or binary.
inline void op4(std::string_view bytes) { read_op4_matrices(std::string(bytes), "fuzz.op4"); }

inline void sid(std::string_view bytes) { parse_sid(bytes, "fuzz.sid"); }

/// Checksums would keep every change away from the reader: the first line names a member of a valid
/// file, the rest takes its place. The bytes alone are tried as an archive and as an array too.
inline void body_file(std::string_view bytes) {
  static const std::string valid = [] {
    BodyFile content;
    FlexibleBody& body = content.part.body;
    body.invariants = InertiaInvariants::zero(2);
    body.invariants.m = 1.0;
    body.invariants.P_u = Mat3::Identity();
    for (std::size_t i = 0; i < 3; ++i) body.invariants.Sij[i][i] = MatX::Identity(2, 2);
    body.K = body.D = MatX::Identity(2, 2);
    body.fixed_interface_frequencies = VecX::Ones(1);
    body.mode_names = {"a", "b"};
    body.nodes = {{"tip", Vec3::Zero(), Mat3X::Zero(3, 2), Mat3X::Zero(3, 2)}};
    content.part.surface.nodes = {0, 1, 2};
    content.part.surface.triangles = {{0, 1, 2}};
    content.part.surface_positions = Mat3X::Zero(3, 3);
    content.part.surface_modes = MatX::Zero(9, 2);
    ProjectionData data;
    data.p = Mat3X::Zero(3, 2);
    data.X = MatX::Zero(6, 2);
    data.M_s.resize(2, 2);
    data.M_s.setIdentity();
    data.M_s *= 0.5;
    body.projection = std::make_shared<const ProjectionData>(data);
    return body_file_bytes(content);
  }();
  try {
    read_zip(bytes, "fuzz.ffb");
  } catch (const InputError&) {
  }
  try {
    read_npy(bytes);
  } catch (const InputError&) {
  }
  const std::size_t line = bytes.find('\n');
  if (line == std::string_view::npos) return;
  std::vector<ZipMember> members = read_zip(valid, "valid.ffb");
  for (ZipMember& m : members)
    if (m.name == bytes.substr(0, line)) m.content = bytes.substr(line + 1);
  read_body_bytes(zip_archive(members), "fuzz.ffb");
}

/// The first line is the ending, the rest the file.
inline void geometry(std::string_view bytes) {
  const std::size_t line = bytes.find('\n');
  if (line == std::string_view::npos || line > 10) return;
  parse_geometry(bytes.substr(line + 1), "fuzz." + std::string(bytes.substr(0, line)));
}

inline void read_all(const StateHistory& history) {
  std::vector<double> row(history.header().columns);
  for (std::size_t k = 0; k < history.instants(); ++k) history.instant(k, row);
  for (std::size_t k = 0; k < history.header().arrays.size(); ++k)
    static_cast<void>(history.numbers(k));
}

/// Checksums would keep every change away from what is behind them: bytes that do not begin as a
/// file are the contents of blocks, the header first, then those of kinds D, R or E.
inline void history(std::string_view bytes) {
  if (bytes.starts_with(history_magic))
    return read_all(StateHistory::of_bytes(std::string(bytes), "fuzz.ffr"));
  const std::vector<std::string> parts = parts_of(bytes, 20);
  std::string file = history_beginning() + history_block(HistoryBlockKind::head, parts[0]);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const char kind = parts[k].empty() ? 'R' : parts[k][0];
    file += history_block(kind == 'D'   ? HistoryBlockKind::data
                          : kind == 'E' ? HistoryBlockKind::done
                                        : HistoryBlockKind::rows,
                          std::string_view(parts[k]).substr(parts[k].empty() ? 0 : 1));
  }
  read_all(StateHistory::of_bytes(std::move(file), "fuzz.ffr"));
}

/// Read, and asked for heights within and beside it.
inline void crg(std::string_view bytes) {
  const CrgRoad road = read_crg(bytes, "fuzz");
  for (int k = -3; k < 4; ++k) crg_surface(road, 0.7 * k, 0.3 * k * k - 1.0);
}

struct Reader {
  const char* name;
  void (*read)(std::string_view bytes);
  double bytes = 2e6;  ///< of memory that it may take of any input
};

inline constexpr Reader readers[] = {
    {"text", text},
    {"abaqus", abaqus},
    {"ansys", ansys, 64e6},  // beam sections are solved with finite elements, one at a time
    {"calculix_matrices", calculix_matrices},
    {"abaqus_matrices", abaqus_matrices},
    {"matrix_market", matrix_market},
    {"gmsh", gmsh},
    {"nastran", nastran},
    {"unv", unv},
    {"dmig", dmig},
    {"op4", op4},
    {"sid", sid, 16e6},  // matrices of up to 500 modes
    {"body_file", body_file},
    {"geometry", geometry},
    {"udp", udp},
    {"history", history},
    {"tir", tir},
    {"crg", crg},
};

/// Reads and forgets. Everything but an InputError is an error of the reader.
inline void run(const Reader& reader, std::string_view bytes) {
  try {
    reader.read(bytes);
  } catch (const InputError&) {
  }
}

}  // namespace floatframe::fuzz
