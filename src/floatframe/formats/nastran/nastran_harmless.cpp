#include <algorithm>
#include <string_view>

#include "floatframe/formats/nastran/nastran_cards.hpp"

namespace floatframe {
namespace {

/// Cards that change neither stiffness nor mass nor geometry; '*' stands for any end.
const char* const harmless_cards[] = {
    "PLOTEL*", "EIG*",   "FORCE*",   "MOMENT*", "PLOAD*",  "GRAV",   "RFORCE",  "ACCEL*",  "LOAD*",
    "TEMP*",   "SPCADD", "SPCD",     "SPCOFF*", "ASET*",   "BSET*",  "BNDFIX*", "BNDFRE*", "CSET*",
    "QSET*",   "USET*",  "OMIT*",    "SUPORT*", "SUPAX",   "TABLE*", "TABD*",   "DAREA",   "DELAY",
    "DPHASE",  "FREQ*",  "RLOAD*",   "TLOAD*",  "TSTEP*",  "NLPARM", "NLPCI",   "DCON*",   "DRESP*",
    "DES*",    "DV*",    "DOPT*",    "DTABLE*", "DLINK",   "DEQATN", "TIC",     "CORD1*",  "MAT2",
    "MAT3",    "MAT4",   "MAT5",     "MAT8",    "MAT9",    "MAT10*", "MATS1",   "MATG",    "MDLPRM",
    "ECHO*",   "SPOINT", "RANDPS",   "RCROSS",  "DLOAD",   "LSEQ",   "SEQGP",   "GROUP",   "RANDT*",
    "NLSTEP",  "NLOUT",  "NLAUTO",   "SLOAD",   "DEFORM",  "TICD",   "PSET",    "PVAL",    "OUTRCV",
    "BOUTPUT", "UNITS",  "METADATA", "MODTRAK", "DYNRED",  "QVECT",  "QVOL",    "QBDY*",   "QHBDY",
    "CHBDY*",  "PHBDY",  "CONV",     "CONVM",   "PCONV*",  "RADSET", "RADM*",   "VIEW*",   "AERO*",
    "CAERO*",  "PAERO*", "SPLINE*",  "AEFACT",  "AELIST",  "AESTAT", "AESURF*", "TRIM",    "FLFACT",
    "FLUTTER", "GUST",   "MKAERO*",  "MONPNT*", "MONDSP*", "DIVERG"};

}  // namespace

bool is_harmless_nastran_card(const std::string& name) {
  return std::any_of(
      std::begin(harmless_cards), std::end(harmless_cards), [&name](std::string_view known) {
        return known.ends_with('*') ? name.starts_with(known.substr(0, known.size() - 1))
                                    : name == known;
      });
}

}  // namespace floatframe
