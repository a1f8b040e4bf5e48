#include "floatframe/decks/nastran/nastran_content.hpp"

namespace floatframe {
namespace {

/// Cards that change neither stiffness nor mass nor geometry; '*' matches any end.
constexpr std::string_view harmless_cards =
    // loads, methods, supports
    "EIG* FORCE* MOMENT* MOMAX PLOAD* PRES* GRAV RFORCE* ACCEL* LOAD* CLOAD TEMP* TTEMP SPCD SPCR "
    "SPCAX SPCOFF* ASET* BSET* BNDFIX* BNDFRE* CSET* QSET* USET* OMIT* SUPORT* SUPAX DAREA DELAY "
    "DPHASE DLOAD LSEQ SLOAD DEFORM TIC* DYNRED SEQGP BOLT* RVDOF* FREQ* RLOAD* TLOAD* TSTEP* "
    "TSTP* DAMPING DAMPGBL HYBDAMP EPOINT ACSRCE ALOAD ACMODL DESC RSPEC RESPSPC MFREQ "
    // nonlinear solutions
    "NLPARM NLPCI NLSTEP NLOUT NLAUTO NLADAPT NLMOPTS NLSTRAT NLFREQ* NLHARM NOLIN* NLRGAP NLRSFD "
    "NLCNTL* MDLPRM PARAMARC ITER SOLVTYP IMPERF* IPSTRAIN ISTRESS INITSO STABP* "
    // tables and tables of data
    "TABLE* TABL3D* TABLRPC TABD* TABRND* RANDPS RANDT* RCROSS DTI DMI DMIJ DMIJI DMIK PARVEC "
    // optimisation
    "DCON* DRESP* DES* DV* DOPT* DTABLE* DLINK* DEQATN DSCREEN DRAPE* DOBJ* DTPL DTPG DSIZE "
    "DSHAPE DSHUFF* DGLOBAL DREPORT* DREPADD DCOMP DSMDV TOPVAR TOMVAR BEADVAR BLDVAR BNDGRID "
    "MODTRAK ADAPT "
    // output, plots and marks
    "PLOTEL* ECHO* GROUP OUTRCV OUTPUT BOUTPUT UNITS METADATA CBARAO SETREF PSET PVAL GM* FEEDGE "
    "FEFACE DEBUG ACCSSPT TITLE SUBTITLE SUBTI LABEL CAMPBL* ERPPNL MONPNT* MONDSP* MONGRP "
    "MONSUM* MONCNCM SWLDPRM PRINT* GEOMCHECK "
    // rotors: gyroscopic terms, which are not of the part
    "ROTOR* RSPIN* RGYRO ROTPARM ROTHYBD ROTBENT UNBALNC "
    // coordinate systems and materials, which are errors where they are used
    "CORD3* MAT3 MAT4 MAT5 MAT10* MAT11* MATS1 MATG MATHP* MATHE* MATORT MATEP MATF* MATVP MATVE "
    "MATSMA MATUSR MATUDS MATNLE* MATPE* MATDMG MATCRP MATTC MATT4 MATT5 MATDIGI "
    // heat
    "QVECT QVOL QBDY* QHBDY CHBDY* PHBDY CONV CONVM PCONV* RADSET RADM* RADBC RADBND RADLST "
    "RADCAV RADCOL RADCT VIEW* BDYOR CHGEN* CFTUBE PFTUBE THPAD "
    // dampers
    "CVISC PVISC CDAMP* PDAMP "
    // properties of elements that are rejected, or of frequency-dependent ones
    "PELAST PBUSHT PBUSH2D PDAMPT PDAMP5 PGAP PFAST PWELD PSEAM PAABSF PACABS PACBAR PACINF PBEND "
    "PCONEAX PLPLANE PRAC2D PRAC3D "
    // aeroelasticity, also of ZAERO and ASTROS
    "AERO* CAERO* PAERO* SPLINE* AEFACT AELIST* AESTAT AESURF* AEPARM AELINK AECOMP* AEFORCE "
    "AEPRESS AEQUAD4 AETRIA3 AEGRID AEROS AEDW AEPLOT* AESCALE ACOORD CSSCHD TRIM* FLFACT FLUTTER "
    "FLUTTF FLTFAST FLTPARM FLSYM FLCOND GUST* GENGUST MKAERO* DIVERG UXVEC SET2 SET4 PANLST* "
    "BODY7 SEGMESH ATTACH MLD* PLT* RUNGEN "
    // regions and parameters of contact, which have no effect without the cards below
    "BC* BSURF* BEDGE BFRIC BLSEG BWIDTH";

/// These change something.
constexpr std::string_view contact_cards = "BCTABLE BCTABL1 BCTSET BCONP BCONECT";

struct RefusedCards {
  std::string_view cards;
  const char* reason;
};

/// Cards that are rejected with a specific sentence.
constexpr RefusedCards refused_cards[] = {
    {"CBEND", "curved beams are not supported; divide the arc into CBAR elements"},
    {"CBEAM3", "beams of three nodes are not supported; divide them into CBAR elements"},
    {"RSPLINE", "interpolation along a spline is not supported; use RBE3 or MPC"},
    {"RSSCON", "connections of shells to solids are not supported; use RBE3 or MPC"},
    {"RTRPLT1", "rigid triangles with nodes that follow only in part are not supported; use RBE2"},
    {"CBUSH2D", "bushings of two directions are not supported; give CBUSH"},
    {"CGAP", "gaps are not linear; replace those that are closed with CELAS2 or RBE2"},
    {"GENEL", "general elements are not supported"},
    {"CFAST", "fasteners are not supported; replace them with RBE3 and CBUSH"},
    {"CWELD", "welds are not supported; replace them with RBE3 and CBUSH"},
    {"CSEAM", "seam welds are not supported; replace them with RBE3 and CBUSH"},
    {"NSM*", "put the mass into NSM of the properties or into CONM2"},
    {"PBMSECT", "sections of any outline are not supported; give A, I1, I2 and J with PBEAM"},
    {"PBCOMP", "lumped sections are not supported; give A, I1, I2 and J with PBEAM"},
    {"PBRSECT", "sections of any outline are not supported; give A, I1, I2 and J with PBAR"},
    {"TF", "transfer functions add stiffness and mass; take them out"},
    {"CHACAB CHACBR CAABSF CACINF* CFLUID* CAXIF* CSLOT*", "acoustic elements are not supported"},
    {"BGSET", "glued surfaces are not supported; tie them with RBE3 or MPC"},
    {"SE* CSUP* RELEASE EXTRN", "superelements are not supported; write one model without them"},
    {"CYJOIN CYSYM", "cyclic symmetry is not supported; write the whole part"},
    {"CCONEAX CTRIAX* CQUADX* CTRAX*", "axisymmetric elements are not supported"},
    {"CPLST*", "elements of plane stress and strain are not supported"},
    {contact_cards, "contact is not linear; tie what touches with RBE2 or MPC, or take it out"},
};

}  // namespace

bool is_harmless_nastran_card(std::string_view name) {
  static const WordList harmless(harmless_cards), contact(contact_cards);
  return harmless.contains(name) && !contact.contains(name);
}

const char* why_nastran_card_is_refused(std::string_view name) {
  const auto* const it =
      std::find_if(std::begin(refused_cards), std::end(refused_cards),
                   [name](const RefusedCards& r) { return WordList(r.cards).contains(name); });
  return it == std::end(refused_cards) ? nullptr : it->reason;
}

}  // namespace floatframe
