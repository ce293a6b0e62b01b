#include "core/nc/dialect/sinumerik_names.h"

#include <algorithm>
#include <array>
#include <span>

namespace trc {
namespace {

using enum SinumerikMeaning;

struct Name {
  std::string_view name;
  SinumerikMeaning meaning;
};

constexpr auto names = std::to_array<Name>({
    {"AMIRROR", frame},
    {"AROT", frame},
    {"AROTS", frame},
    {"ASCALE", unfollowed},
    {"ASPLINE", spline},
    {"ATRANS", frame},
    {"BAUTO", technology},
    {"BNAT", technology},
    {"BRISK", technology},
    {"BRISKA", technology},
    {"BSPLINE", spline},
    {"BTAN", technology},
    {"CASE", statement},
    {"CFTCP", technology},
    {"CLEARM", technology},
    {"CLGOF", technology},
    {"CLGON", technology},
    {"COMPCAD", technology},
    {"COMPCURV", technology},
    {"COMPOF", technology},
    {"COMPON", technology},
    {"COMPSURF", technology},
    {"CORROF", frame},
    {"CP", technology},
    {"CPRECOF", technology},
    {"CPRECON", technology},
    {"CSPLINE", spline},
    {"CUT2D", spatial_end},
    {"CUT2DF", spatial_end},
    {"CUT3DC", spatial},
    {"CUT3DCC", spatial},
    {"CUT3DCCD", spatial},
    {"CUT3DCD", spatial},
    {"CUT3DF", spatial},
    {"CUT3DFD", spatial},
    {"CUT3DFF", spatial},
    {"CUT3DFS", spatial},
    {"CUTCONOF", technology},
    {"CUTCONON", suppression},
    {"DEF", statement},
    {"DELAYFSTOF", technology},
    {"DELAYFSTON", technology},
    {"DIAM90", turning},
    {"DIAMOF", technology},
    {"DIAMON", turning},
    {"DISPLOF", technology},
    {"DISPLON", technology},
    {"DRFOF", technology},
    {"DRIVE", technology},
    {"DYNFINISH", technology},
    {"DYNNORM", technology},
    {"DYNPOS", technology},
    {"DYNPREC", technology},
    {"DYNROUGH", technology},
    {"DYNSEMIFIN", technology},
    {"EAUTO", technology},
    {"ELSE", statement},
    {"ENAT", technology},
    {"ENDFOR", statement},
    {"ENDIF", statement},
    {"ENDLOOP", statement},
    {"ENDWHILE", statement},
    {"ETAN", technology},
    {"EXTCALL", statement},
    {"EXTERN", statement},
    {"FENDNORM", technology},
    {"FFWOF", technology},
    {"FFWON", technology},
    {"FIFOCTRL", technology},
    {"FLIN", technology},
    {"FNORM", technology},
    {"FOR", statement},
    {"GOTO", statement},
    {"GOTOB", statement},
    {"GOTOC", statement},
    {"GOTOF", statement},
    {"GOTOS", statement},
    {"GROUP_END", technology},
    {"IF", statement},
    {"INVCCW", spline},
    {"INVCW", spline},
    {"LFOF", technology},
    {"LFON", technology},
    {"LOOP", statement},
    {"MCALL", modal_cycle},
    {"MIRROR", frame},
    {"ORIAXES", technology},
    {"ORIC", technology},
    {"ORICURVE", technology},
    {"ORID", technology},
    {"ORIEULER", technology},
    {"ORIMKS", technology},
    {"ORIPLANE", technology},
    {"ORIRESET", technology},
    {"ORIROTA", technology},
    {"ORIRPY", technology},
    {"ORISOF", technology},
    {"ORISON", technology},
    {"ORIVECT", technology},
    {"ORIVIRT1", technology},
    {"ORIWKS", technology},
    {"OSB", technology},
    {"OSC", technology},
    {"OSD", technology},
    {"OSOF", technology},
    {"OSS", technology},
    {"OSSE", technology},
    {"OST", technology},
    {"PAROT", frame},
    {"PAROTOF", technology},
    {"POLY", spline},
    {"PROC", statement},
    {"REPEAT", statement},
    {"REPEATB", statement},
    {"RET", statement},
    {"ROT", frame},
    {"ROTS", frame},
    {"RTLIOF", technology},
    {"RTLION", technology},
    {"SBLOF", technology},
    {"SBLON", technology},
    {"SCALE", unfollowed},
    {"SETMS", technology},
    {"SOFT", technology},
    {"SOFTA", technology},
    {"SPATH", technology},
    {"SPCOF", technology},
    {"SPCON", technology},
    {"SPIF1", technology},
    {"SPIF2", technology},
    {"STARTFIFO", technology},
    {"STOPFIFO", technology},
    {"STOPRE", technology},
    {"SUPA", single_move},
    {"TCOABS", technology},
    {"TOFRAME", frame},
    {"TOFRAMEX", frame},
    {"TOFRAMEY", frame},
    {"TOFRAMEZ", frame},
    {"TOROT", frame},
    {"TOROTOF", frame},
    {"TOROTX", frame},
    {"TOROTY", frame},
    {"TOROTZ", frame},
    {"TOWSTD", technology},
    {"TRAANG", unfollowed},
    {"TRACON", unfollowed},
    {"TRACYL", unfollowed},
    {"TRAFOOF", unfollowed_end},
    {"TRAFOON", unfollowed},
    {"TRANS", frame},
    {"TRANSMIT", unfollowed},
    {"TRAORI", unfollowed},
    {"UNTIL", statement},
    {"UPATH", technology},
    {"WAITENC", technology},
    {"WAITS", technology},
    {"WALIMOF", technology},
    {"WALIMON", technology},
    {"WHILE", statement},
});
static_assert(std::ranges::is_sorted(names, {}, &Name::name));

// Calls that change neither the modes nor the position: of the language (D-174) and CYCLE832.
constexpr auto passing_calls = std::to_array<std::string_view>(
    {"BRISKA",       "CANCEL",    "CANCELSUB",   "CLEARM",  "CLRINT",    "COUPDEF",  "COUPDEL",
     "COUPOF",       "COUPOFS",   "COUPON",      "COUPONC", "COUPRES",   "CPROT",    "CYCLE832",
     "DELETE",       "DELT",      "DELTC",       "DISABLE", "DRIVEA",    "EGDEF",    "EGDEL",
     "ENABLE",       "EXTCLOSE",  "EXTOPEN",     "FCTDEF",  "FGROUP",    "FILEDATE", "FILEINFO",
     "FILESIZE",     "FILESTAT",  "FILETIME",    "FPRAOF",  "FPRAON",    "GETEXET",  "GETSELT",
     "GROUP_ADDEND", "GROUP_END", "GROUP_BEGIN", "GWPSOF",  "GWPSON",    "INIT",     "JERKA",
     "LOCK",         "MASLDEF",   "MASLDEL",     "MMC",     "MSG",       "NPROT",    "ORIRESET",
     "POSM",         "PROTA",     "PROTD",       "PROTS",   "PUNCHACC",  "QECLRNOF", "QECLRNON",
     "READ",         "RESETMON",  "SETAL",       "SETM",    "SETMS",     "SETPIECE", "SETTA",
     "SETTIA",       "SOFTA",     "SPCOF",       "SPCON",   "SPOS",      "START",    "TANG",
     "TANGDEL",      "TCI",       "TLIFT",       "TMOF",    "TMON",      "UNLOCK",   "WAITE",
     "WAITM",        "WAITMC",    "WAITP",       "WAITS",   "WORKPIECE", "WRITE"});
// Calls after which only the machine knows where the axes stand that they name (D-174).
struct AxisCall {
  std::string_view name;
  SinumerikAxisCall effect;
};
constexpr auto axis_calls = std::to_array<AxisCall>({
    {"AXTOCHAN", SinumerikAxisCall::displaces},  {"EGOFC", SinumerikAxisCall::uncouples},
    {"EGOFS", SinumerikAxisCall::uncouples},     {"EGON", SinumerikAxisCall::couples},
    {"EGONSYN", SinumerikAxisCall::couples},     {"EGONSYNE", SinumerikAxisCall::couples},
    {"GET", SinumerikAxisCall::displaces},       {"GETD", SinumerikAxisCall::displaces},
    {"LEADOF", SinumerikAxisCall::uncouples},    {"LEADON", SinumerikAxisCall::couples},
    {"MASLOF", SinumerikAxisCall::uncouples},    {"MASLOFS", SinumerikAxisCall::uncouples},
    {"MASLON", SinumerikAxisCall::couples},      {"PRESETON", SinumerikAxisCall::displaces},
    {"PRESETONS", SinumerikAxisCall::displaces}, {"RELEASE", SinumerikAxisCall::displaces},
    {"TANGOF", SinumerikAxisCall::displaces},    {"TANGON", SinumerikAxisCall::displaces},
    {"TRAILOF", SinumerikAxisCall::uncouples},   {"TRAILON", SinumerikAxisCall::couples},
});
// CYCLE, HOLES, POCKET, SLOT and the like: only the control knows their motions.
constexpr auto cycle_beginnings = std::to_array<std::string_view>(
    {"CYCLE", "HOLES", "POCKET", "SLOT", "LONGHOLE", "TRANSMIT", "TRACYL", "F_"});
// Words with values that do not affect the path.
constexpr auto passing_assignments = std::to_array<std::string_view>({"$AC_ACTUAL_PARTS",
                                                                      "$AC_MARKER",
                                                                      "$AC_PARAM",
                                                                      "$AC_REQUIRED_PARTS",
                                                                      "$AC_SPECIAL_PARTS",
                                                                      "$AC_TIMER",
                                                                      "$AC_TOTAL_PARTS",
                                                                      "$A_DB",
                                                                      "$A_DL",
                                                                      "$A_OUT",
                                                                      "$TC_",
                                                                      "ACC",
                                                                      "ADIS",
                                                                      "ADISPOS",
                                                                      "ALF",
                                                                      "ATOL",
                                                                      "CTOL",
                                                                      "FA",
                                                                      "FB",
                                                                      "FD",
                                                                      "FGREF",
                                                                      "FL",
                                                                      "FP",
                                                                      "FZ",
                                                                      "JERKLIM",
                                                                      "LIMS",
                                                                      "OTOL",
                                                                      "OVR",
                                                                      "SCC",
                                                                      "SPOS",
                                                                      "SVC",
                                                                      "VELOLIM"});
// Words of the language with values that are not read here.
constexpr auto unread_words = std::to_array<std::string_view>(
    {"AX",   "DILF", "DISPR", "FMA", "FOC",  "FXS",  "FXST",  "FXSW", "ISD",
     "LEAD", "NUT",  "PHI",   "PL",  "PO",   "POLF", "PSI",   "PW",   "SD",
     "SR",   "SRA",  "ST",    "STA", "STAT", "TA",   "THETA", "TILT", "TU"});
// Words that change the radius, or end a motion where only the control knows.
struct RefusedWord {
  std::string_view beginning;
  std::string_view why;
};
constexpr auto refused_words = std::to_array<RefusedWord>(
    {{"MEA", "measuring"}, {"TOFF", "an offset of the tool beside its data"}});
// Words with values that round or bevel corners.
constexpr auto corner_words = std::to_array<std::string_view>({"FRC", "FRCM"});
// Names with a meaning that the table above cannot express.
constexpr auto names_of_motion = std::to_array<std::string_view>(
    {"CDOF", "CDOF2", "CDON", "CFC", "CFIN", "CIP", "CT", "KONT", "KONTC", "KONTT", "NORM"});
// Words with values that the reader follows.
constexpr auto followed_words = std::to_array<std::string_view>(
    {"ANG",  "AP",  "AR",   "CHF", "CHR", "CR",   "DISC",   "DISCL", "DISR", "DISRP", "FAD",
     "OFFN", "RND", "RNDM", "RP",  "RPL", "TURN", "CUTMOD", "POS",   "POSA", "TCARR", "DL"});

bool begins_with_any(std::string_view name, std::span<const std::string_view> beginnings) {
  return std::ranges::any_of(beginnings,
                             [&](std::string_view begin) { return name.starts_with(begin); });
}

bool is_one_of(std::string_view name, std::span<const std::string_view> names_wanted) {
  return std::ranges::find(names_wanted, name) != names_wanted.end();
}

}  // namespace

std::optional<SinumerikMeaning> meaning_of_sinumerik_name(std::string_view name) {
  const auto found = std::ranges::lower_bound(names, name, {}, &Name::name);
  if (found == names.end() || found->name != name) return std::nullopt;
  return found->meaning;
}

bool is_sinumerik_statement(std::string_view name) {
  return meaning_of_sinumerik_name(name) == statement;
}

bool is_sinumerik_name(std::string_view name) {
  return meaning_of_sinumerik_name(name).has_value() || is_one_of(name, names_of_motion);
}

bool is_sinumerik_cycle(std::string_view name) { return begins_with_any(name, cycle_beginnings); }

bool is_passing_sinumerik_call(std::string_view name) { return is_one_of(name, passing_calls); }

std::optional<SinumerikAxisCall> axis_call_of_sinumerik(std::string_view name) {
  const auto found = std::ranges::find(axis_calls, name, &AxisCall::name);
  return found == axis_calls.end() ? std::nullopt : std::optional(found->effect);
}

bool is_sinumerik_call(std::string_view name) {
  return is_sinumerik_cycle(name) || name == "TRAORI" || is_passing_sinumerik_call(name) ||
         axis_call_of_sinumerik(name).has_value();
}

bool is_sinumerik_frame(std::string_view name) {
  return name.starts_with("$P_") && (name.ends_with("FR") || name.ends_with("FRAME"));
}

bool is_passing_sinumerik_word(std::string_view name) {
  return begins_with_any(name, passing_assignments);
}

bool is_sinumerik_corner_word(std::string_view name) { return is_one_of(name, corner_words); }

std::string_view refusal_of_sinumerik_word(std::string_view name) {
  const auto found = std::ranges::find_if(
      refused_words, [&](const RefusedWord& word) { return name.starts_with(word.beginning); });
  return found == refused_words.end() ? std::string_view() : found->why;
}

bool is_sinumerik_word(std::string_view name) {
  return is_passing_sinumerik_word(name) || is_sinumerik_frame(name) ||
         is_sinumerik_corner_word(name) || is_one_of(name, followed_words) ||
         !refusal_of_sinumerik_word(name).empty();
}

bool is_unread_sinumerik_word(std::string_view name) { return is_one_of(name, unread_words); }

bool is_sinumerik_word_of_any_kind(std::string_view name) {
  return is_sinumerik_name(name) || is_sinumerik_call(name) || is_sinumerik_word(name);
}

}  // namespace trc
