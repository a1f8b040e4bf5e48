// The commands of a deck: those that are read, and those that change neither stiffness nor mass.
// Any other stops the reading.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "floatframe/decks/ansys/ansys_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "floatframe/formats/text/text_source.hpp"

namespace floatframe {
namespace {

struct AnsysCommand {
  const char* name;
  AnsysCommandReader read;
};

/// Sets the number that elements get from now on.
template <int AnsysContent::*Member>
void set_number(AnsysFields& f, AnsysContent& c) {
  c.*Member = f.integer(1, "the number");
}

void set_parameter(AnsysFields& f, AnsysContent&) { f.set_parameter(f.text(1), f.number(2)); }

/// Its value is not known: an error where it is used.
void get_parameter(AnsysFields& f, AnsysContent&) { f.set_parameter(f.text(1), {}); }

/// Of CDWRITE: *IF,_CDRDOFF,EQ,1,THEN / *ELSE / *ENDIF around NUMOFF; its *ELSE is read.
void begin_branch(AnsysFields& f, AnsysContent& c) {
  if (f.word(1) != "_CDRDOFF")
    f.stop(ErrorCode::unsupported,
           "*IF: branches are not read, but that of CDWRITE over _CDRDOFF; found {}",
           shown(f.text(1)));
  c.branch = 1;
}
void turn_branch(AnsysFields&, AnsysContent& c) { c.branch = 0; }

void set_lumped(AnsysFields& f, AnsysContent& c) {
  const std::string word = f.word(1);
  c.lumped = word == "ON" || word == "1";
  if (!c.lumped && !word.empty() && word != "OFF" && word != "0")
    f.stop(ErrorCode::wrong_value, "LUMPM: expected ON or OFF, found {}", shown(f.text(1)));
}

void skip_with_block(AnsysFields& f, AnsysContent& c) {
  c.passed_over.try_emplace(f.command(), f.at());
  f.skip_block();
}

/// The shape of the targets that follow: those of nodes are told by their nodes, a pilot by having
/// one.
void check_target_shape(AnsysFields& f, AnsysContent&) {
  constexpr std::array of_nodes = {"LINE", "PARA", "TRIA", "TRI6", "QUAD", "QUA8", "PILO", "POIN"};
  const std::string shape = f.word(1);
  if (shape.empty() || std::any_of(of_nodes.begin(), of_nodes.end(),
                                   [&](const char* name) { return shape.starts_with(name); }))
    return;
  f.stop(ErrorCode::unsupported,
         "TSHAP: targets of the shape {} are not read, expected one of nodes (LINE, PARA, TRIA, "
         "TRI6, QUAD, QUA8, POINT) or a pilot node (PILO)",
         shown(f.text(1)));
}

void note_units(AnsysFields& f, AnsysContent& c) {
  c.model.notes.push_back(fmt::format(
      "{}:{}: the file says that its units are {}; the units given with the file are taken",
      f.source().files()[f.at().file], f.at().line, shown(f.text(1))));
}

void end_of_file(AnsysFields&, AnsysContent& c) { c.ended = true; }

constexpr AnsysCommand ansys_commands[] = {
    {"N", read_ansys_node},
    {"NBLOCK", read_ansys_node_block},
    {"E", read_ansys_element},
    {"EN", read_ansys_element},
    {"EMORE", read_ansys_element_more},
    {"EBLOCK", read_ansys_element_block},
    {"CMBLOCK", read_ansys_component},
    {"LOCAL", read_ansys_system},
    {"CSYS", set_number<&AnsysContent::nodal_system>},
    {"ET", read_ansys_type},
    {"ETBLOCK", read_ansys_type_block},
    {"KEYOPT", read_ansys_key_option},
    {"TYPE", set_number<&AnsysContent::type>},
    {"MAT", set_number<&AnsysContent::material>},
    {"REAL", set_number<&AnsysContent::real>},
    {"SECNUM", set_number<&AnsysContent::section>},
    {"ESYS", set_number<&AnsysContent::system>},
    {"R", read_ansys_real},
    {"RMORE", read_ansys_real_more},
    {"RLBLOCK", read_ansys_real_block},
    {"SECTYPE", read_ansys_section},
    {"SECDATA", read_ansys_section_data},
    {"SECBLOCK", read_ansys_section_block},
    {"SECOFFSET", read_ansys_section_offset},
    {"SECCONTROL", read_ansys_section_control},
    {"MP", read_ansys_material},
    {"MPTEMP", read_ansys_temperatures},
    {"MPDATA", read_ansys_material_data},
    {"TB", read_ansys_table},
    {"TBTEMP", read_ansys_table_temperature},
    {"TBFIELD", read_ansys_table_field},
    {"TBDATA", read_ansys_table_data},
    {"CE", read_ansys_equation},
    {"CP", read_ansys_coupling},
    {"CERIG", read_ansys_rigid},
    {"D", read_ansys_support},
    {"TSHAP", check_target_shape},
    {"LUMPM", set_lumped},
    {"*SET", set_parameter},
    {"*GET", get_parameter},
    {"*IF", begin_branch},
    {"*ELSE", turn_branch},
    {"*ENDIF", turn_branch},
    {"/UNITS", note_units},
    {"/EOF", end_of_file},
    {"BFBLOCK", skip_with_block},
    {"BFEBLOCK", skip_with_block},
    {"SFEBLOCK", skip_with_block},
    {"DMPBLOCK", skip_with_block},
    {"CSYSBLOCK", skip_with_block},
};

/// Loads, solutions, files, pictures: ignored without a word.
constexpr std::array ansys_silent = {
    "/PREP7",     "/NOPR",     "/GOPR",    "/GO",     "/TITLE",     "/SOLU",      "/SOL",
    "/POST1",     "/POST26",   "/BATCH",   "/CONFIG", "/SHOW",      "/OUTPUT",    "/STITLE",
    "/NERR",      "/GST",      "/FILNAME", "/CLEAR",  "/WB",        "/VIEW",      "/ESHAPE",
    "/COLOR",     "/PBC",      "/PNUM",    "/REPLOT", "/NUMBER",    "/AUX15",     "/DEVICE",
    "/GRAPHICS",  "/EXIT",     "/DELETE",  "/UIS",    "FINISH",     "NUMOFF",     "DOF",
    "CSCIR",      "CMGRP",     "CMSEL",    "ALLSEL",  "EXTOPT",     "SHPP",       "CHECK",
    "SAVE",       "TBPT",      "TBEO",     "FC",      "ANTYPE",     "MODOPT",     "MXPAND",
    "EMUNIT",     "TOFFST",    "STEF",     "TRNOPT",  "THOPT",      "DMPOPT",     "EQSLV",
    "HROPT",      "BUCOPT",    "LVSCALE",  "MSAVE",   "SOLVE",      "NLGEOM",     "PSTRES",
    "SSTIF",      "OUTPR",     "OUTRES",   "ERESX",   "TREF",       "TUNIF",      "BFUNIF",
    "IRLF",       "ACEL",      "OMEGA",    "DOMEGA",  "CGLOC",      "CGOMGA",     "DCGOMG",
    "CMOMEGA",    "KUSE",      "TIME",     "ALPHAD",  "BETAD",      "DMPRAT",     "DMPSTR",
    "CRPLIM",     "NCNV",      "NEQIT",    "AUTOTS",  "KBC",        "DELTIM",     "NSUBST",
    "CNVTOL",     "LNSRCH",    "PRED",     "TIMINT",  "TINTP",      "NROPT",      "RATE",
    "RESCONTROL", "F",         "SF",       "SFE",     "BF",         "BFE",        "FDELE",
    "DDELE",      "LSWRITE",   "LSCLEAR",  "NSEL",    "ESEL",       "NSLE",       "ESLN",
    "SHSD",       "PRNSOL",    "SET",      "EPLOT",   "NPLOT",      "STAOPT",     "SBCLIM",
    "BCSOPTION",  "DSPOPTION", "NLDIAG",   "RSTOFF",  "OPNCONTROL", "CUTCONTROL", "MONITOR",
    "SOLCONTROL", "GRP",       "SPOPT",    "CINT",    "GAUGE",      "IC",         "_CDRDOFF",
    "_BUTTON",    "_RETURN",   "*DIM",     "*STATUS", "TALLOW",     "DMP",        "ETCONTROL",
    "WPSTYLE",    "WPCSYS",    "MPAMOD",   "/NOLIST", "/GOLIST",    "/AUTO",      "/DIST",
    "/ANGLE",     "/TYPE",     "/FOCUS",   "/LINE",   "/RGB",       "/TRIAD",     "/PLOPTS",
    "/EDGE",      "/INQUIRE",  "/XML",     "/STATUS", "/HEADER",    "/PAGE",      "/FORMAT",
    "*ABSET",     "*ABCHECK",  "*ABFINI",  "KEYW",    "TBLIST",     "MPLIST",     "ETLIST",
    "NLIST",      "ELIST",     "CM",       "*CFOPEN", "*CFCLOS",    "*DEL",       "SLIST",
};

/// What to do instead, of commands that are met in decks of a session.
constexpr std::array<std::pair<const char*, const char*>, 24> ansys_refused = {{
    {"*DO", "loops are not read: write the model with CDWRITE"},
    {"PSMESH", "take the cut and its tension out of the model"},
    {"*USE", "macros are not read: write the model with CDWRITE"},
    {"/INPUT", "further files are not read: write the model with CDWRITE"},
    {"K", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"L", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"A", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"V", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"BLOCK", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"VMESH", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"AMESH", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"LMESH", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"NGEN", "generated nodes are not read: write the model with CDWRITE"},
    {"FILL", "generated nodes are not read: write the model with CDWRITE"},
    {"EGEN", "generated elements are not read: write the model with CDWRITE"},
    {"RBE3", "it takes arrays of the session: write the model with CDWRITE, which has it as CE"},
    {"CEINTF", "it takes the selection of the session: write the model with CDWRITE"},
    {"CYCLIC", "cyclic symmetry is not read"},
    {"SECREAD",
     "sections in files of their own are not read: give their constants, SECTYPE,n,BEAM,ASEC"},
    {"SECJOINT", "joints between parts are joints of the model here: leave them out of the part"},
    {"SECFUNCTION", "thickness as a function of the place is not read"},
    {"RESUME", "binary databases are not read: write the model with CDWRITE"},
    {"UPCOORD", "moved nodes are not read: write the model with CDWRITE"},
    {"RMODIF", "changed real constants are not read: write the model with CDWRITE"},
}};

/// Silent ones that need not be told.
constexpr std::array ansys_untold = {"FINISH", "NUMOFF", "DOF",    "CSCIR",   "CMGRP",
                                     "CMSEL",  "ALLSEL", "EXTOPT", "SHPP",    "CHECK",
                                     "SAVE",   "GRP",    "*DIM",   "_BUTTON", "_RETURN"};

class AnsysReader {
 public:
  explicit AnsysReader(TextSource& source) : f_(source) {}

  AnsysContent read() {
    while (!c_.ended && f_.next()) one();
    return std::move(c_);
  }

 private:
  void one() {
    const std::string& word = f_.command();
    if (c_.branch > 0 && word != "*ELSE" && word != "*ENDIF") return;
    if (const std::size_t sign = word.find('='); sign != std::string::npos) return assignment(sign);
    const auto* command =
        std::find_if(std::begin(ansys_commands), std::end(ansys_commands),
                     [&](const AnsysCommand& known) { return f_.is(known.name); });
    if (command != std::end(ansys_commands)) return command->read(f_, c_);
    const auto* refused = std::find_if(ansys_refused.begin(), ansys_refused.end(),
                                       [&](const auto& r) { return f_.is(r.first); });
    if (refused != ansys_refused.end())
      f_.stop(ErrorCode::unsupported, fmt::format("{}: {}", word, refused->second));
    if (std::any_of(ansys_silent.begin(), ansys_silent.end(),
                    [&](const char* name) { return f_.is(name); })) {
      const bool told =
          word.front() != '/' && std::none_of(ansys_untold.begin(), ansys_untold.end(),
                                              [&](const char* name) { return f_.is(name); });
      if (told) c_.passed_over.try_emplace(word, f_.at());
      return;
    }
    if (word == "-1") return;  // the end of a block whose count came first
    f_.stop(ErrorCode::unknown_key,
            fmt::format("{} is not known: whether it changes stiffness or mass is not clear; "
                        "remove it from the file if it does not",
                        shown(f_.text(0))));
  }

  /// NAME=value; a text or an expression is kept as unknown, an error where it is used.
  void assignment(std::size_t sign) {
    const std::string& line = f_.line();
    f_.set_parameter(line.substr(0, sign), parse_real(trimmed(line.substr(sign + 1))));
  }

  AnsysFields f_;
  AnsysContent c_;
};

}  // namespace

AnsysContent read_ansys_content(TextSource& source) { return AnsysReader(source).read(); }

}  // namespace floatframe
