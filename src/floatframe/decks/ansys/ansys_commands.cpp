// The commands of a deck: those that are read, and those that change neither stiffness nor mass.
// Any other command stops the reading.
#include <algorithm>

#include "floatframe/decks/ansys/ansys_content.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Sets the number that elements get from now on.
template <int AnsysElement::*Member>
void set_number(AnsysFields& f, AnsysContent& c) {
  c.current.*Member = f.integer(1, "the number");
}

void set_nodal_system(AnsysFields& f, AnsysContent& c) {
  c.nodal_system = f.integer(1, "the number");
}

void set_parameter(AnsysFields& f, AnsysContent&) { f.set_parameter(f.text(1), f.number(2)); }

/// Its value is unknown: an error where it is used.
void get_parameter(AnsysFields& f, AnsysContent&) { f.set_parameter(f.text(1), {}); }

/// In CDWRITE: *IF,_CDRDOFF,EQ,1,THEN / *ELSE / *ENDIF around NUMOFF; its *ELSE is read.
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
  c.ignored.try_emplace(f.command(), f.at());
  f.skip_block();
}

/// The shape of the targets that follow: those of nodes are identified by their nodes, a pilot by
/// a single one.
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
  f.source().note(c.model, f.at(),
                  "the file declares units {}; the units given with the file are used",
                  shown(f.text(1)));
}

void end_of_file(AnsysFields&, AnsysContent& c) { c.ended = true; }

/// Commands that are complete by themselves.
constexpr AnsysCommand session_commands[] = {
    {"CSYS", set_nodal_system},
    {"TYPE", set_number<&AnsysElement::type>},
    {"MAT", set_number<&AnsysElement::material>},
    {"REAL", set_number<&AnsysElement::real>},
    {"SECNUM", set_number<&AnsysElement::section>},
    {"ESYS", set_number<&AnsysElement::system>},
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

/// Loads, solutions, files, pictures: ignored without a message.
constexpr std::string_view ansys_silent =
    "/PREP7 /NOPR /GOPR /GO /TITLE /SOLU /SOL /POST1 /POST26 /BATCH /CONFIG /SHOW /OUTPUT /STITLE "
    "/NERR /GST /FILNAME /CLEAR /WB /VIEW /ESHAPE /COLOR /PBC /PNUM /REPLOT /NUMBER /AUX15 /DEVICE "
    "/GRAPHICS /EXIT /DELETE /UIS FINISH NUMOFF DOF CSCIR CMGRP CMSEL ALLSEL EXTOPT SHPP CHECK "
    "SAVE TBPT TBEO FC ANTYPE MODOPT MXPAND EMUNIT TOFFST STEF TRNOPT THOPT DMPOPT EQSLV HROPT "
    "BUCOPT LVSCALE MSAVE SOLVE NLGEOM PSTRES SSTIF OUTPR OUTRES ERESX TREF TUNIF BFUNIF IRLF ACEL "
    "OMEGA DOMEGA CGLOC CGOMGA DCGOMG CMOMEGA KUSE TIME ALPHAD BETAD DMPRAT DMPSTR CRPLIM NCNV "
    "NEQIT AUTOTS KBC DELTIM NSUBST CNVTOL LNSRCH PRED TIMINT TINTP NROPT RATE RESCONTROL F SF SFE "
    "BF BFE FDELE DDELE LSWRITE LSCLEAR NSEL ESEL NSLE ESLN SHSD PRNSOL SET EPLOT NPLOT STAOPT "
    "SBCLIM BCSOPTION DSPOPTION NLDIAG RSTOFF OPNCONTROL CUTCONTROL MONITOR SOLCONTROL GRP SPOPT "
    "CINT GAUGE IC _CDRDOFF _BUTTON _RETURN *DIM *STATUS TALLOW DMP ETCONTROL WPSTYLE WPCSYS "
    "MPAMOD /NOLIST /GOLIST /AUTO /DIST /ANGLE /TYPE /FOCUS /LINE /RGB /TRIAD /PLOPTS /EDGE "
    "/INQUIRE /XML /STATUS /HEADER /PAGE /FORMAT *ABSET *ABCHECK *ABFINI KEYW TBLIST MPLIST ETLIST "
    "NLIST ELIST CM *CFOPEN *CFCLOS *DEL SLIST";

/// Alternatives to commands (words between blanks) that occur in decks of a session.
constexpr std::pair<std::string_view, const char*> ansys_refused[] = {
    {"*DO", "loops are not read: write the model with CDWRITE"},
    {"PSMESH", "take the cut and its tension out of the model"},
    {"*USE", "macros are not read: write the model with CDWRITE"},
    {"/INPUT", "further files are not read: write the model with CDWRITE"},
    {"K L A V BLOCK VMESH AMESH LMESH", "geometry is not meshed here: write the mesh with CDWRITE"},
    {"NGEN FILL", "generated nodes are not read: write the model with CDWRITE"},
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
};

/// Ignored commands that need no note.
constexpr std::string_view ansys_untold =
    "FINISH NUMOFF DOF CSCIR CMGRP CMSEL ALLSEL EXTOPT SHPP CHECK SAVE GRP *DIM _BUTTON _RETURN";

/// `names`: words between blanks.
bool is_ansys_word(const AnsysFields& f, std::string_view names) {
  for (auto name = next_word(names); !name.empty(); name = next_word(names))
    if (f.is(name)) return true;
  return false;
}

void read_command(AnsysFields& f, AnsysContent& c) {
  const std::string& word = f.command();
  if (c.branch > 0 && word != "*ELSE" && word != "*ENDIF") return;
  // NAME=value; a text or an expression is kept as unknown, an error where it is used.
  if (const std::size_t sign = word.find('='); sign != std::string::npos)
    return f.set_parameter(f.line().substr(0, sign),
                           parse_real(trimmed(std::string_view(f.line()).substr(sign + 1))));
  for (const auto& commands :
       {ansys_mesh_commands(), ansys_property_commands(), ansys_material_commands(),
        ansys_constraint_commands(), std::span<const AnsysCommand>(session_commands)})
    for (const AnsysCommand& command : commands)
      if (f.is(command.name)) return command.read(f, c);
  for (const auto& [names, advice] : ansys_refused)
    if (is_ansys_word(f, names)) f.stop(ErrorCode::unsupported, "{}: {}", word, advice);
  if (is_ansys_word(f, ansys_silent)) {
    if (word.front() != '/' && !is_ansys_word(f, ansys_untold)) c.ignored.try_emplace(word, f.at());
    return;
  }
  if (word == "-1") return;  // the end of a block whose count came first
  f.stop(ErrorCode::unknown_key,
         "{} is not known: whether it changes stiffness or mass is not clear; remove it from the "
         "file if it does not",
         shown(f.text(0)));
}

}  // namespace

AnsysContent read_ansys_content(TextSource& source) {
  AnsysFields f(source);
  AnsysContent c;
  while (!c.ended && f.next()) read_command(f, c);
  return c;
}

}  // namespace floatframe
