/* Tool radius compensation (G41, G42) for programs in any language: what the service trcd does, in
 * the calling process, without a network.
 *
 *   trc_create -> trc_feed_text or trc_feed_blocks, as often as wanted -> trc_finish ->
 *   trc_summarize -> trc_free; and trc_next wherever answers are wanted, at the latest after
 *   trc_finish.
 *
 * Units. Lengths and coordinates are mm, machine axes, finite and at most 1e6 in size; angles rad;
 * feeds mm/min, above 0 to 1e9. Diagnostics count in mm in their values and in the unit of the
 * program in their texts. Texts are UTF-8 and end with a NUL.
 *
 * Threads. A session is for one thread at a time, and may be given from one to another between two
 * calls. Sessions know nothing of each other: as many as wanted may work at the same time.
 *
 * Growth. Every structure that may grow says its size first, set to sizeof by the caller (0 and
 * sizes that are too small are refused with TRC_ARGUMENT); members are only ever added at the end.
 * What this library does not know of a larger structure must be zero on the way in, and is zero on
 * the way out.
 *
 * Wrong calls give TRC_ARGUMENT or TRC_ORDER and say in trc_last_error what is wrong; unless said
 * otherwise they change nothing. No exception leaves the library.
 */
#ifndef TRC_H
#define TRC_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define TRC_API __attribute__((visibility("default")))
#else
#define TRC_API
#endif

#ifdef __cplusplus
extern "C" {
#endif
/* Names as C has them. NOLINTBEGIN(readability-identifier-naming,modernize-*) */

typedef struct trc_session trc_session;

/* What functions give. */
enum trc_status {
  TRC_OK = 0,
  /* trc_next: there is no more for now; after trc_finish there never will be. */
  TRC_END = 1,
  /* The program or path is refused. The last answers are diagnostics of severity TRC_ERROR that
   * say where, why and what helps. Nothing of it may be machined. */
  TRC_REFUSED = 2,
  /* An argument cannot be taken as it is. */
  TRC_ARGUMENT = 3,
  /* A call at the wrong time, or of a session of the other kind. */
  TRC_ORDER = 4,
  /* Out of memory. The session is of no further use but to trc_free. */
  TRC_MEMORY = 5,
  /* A fault of this library. The session is of no further use but to trc_free. */
  TRC_INTERNAL = 6
};

/* What a session is fed with. */
enum trc_input {
  TRC_INPUT_TEXT = 1,  /* NC text: trc_feed_text */
  TRC_INPUT_BLOCKS = 2 /* motion blocks: trc_feed_blocks */
};

/* What holds before the first line or block. `json`, then `settings` in their order: the last one
 * wins. Both empty: all defaults, without a tool radius. */
typedef struct trc_setup {
  size_t size;   /* sizeof(trc_setup) */
  int32_t input; /* enum trc_input */
  /* What of `settings` there is, at most 10000. */
  uint32_t setting_count;
  /* "key=value" as --set of the command line takes it, as in "tool_radius=5" (mm), "G26" of
   * "transition=G26", "tools=1:5,2:3.5" (text only), "verify=enforce"; all of them: trc
   * compensate --help. */
  const char* const* settings;
  /* The setup as JSON, or NULL: the message ProgramSetup of proto/trc/v1/setup.proto for text, as
   * in {"path": {"toolRadius": 5}, "dialect": "DIALECT_FANUC"}, PathSetup for blocks. Ranges and
   * defaults are said there. What is about a connection (resume_token, response_layout,
   * client_tag, file_name) changes nothing here, but for resume_token, which is refused. */
  const char* json;
} trc_setup;

/* Kinds of blocks, fed and compensated. */
enum trc_kind {
  TRC_RAPID = 1,             /* G00 */
  TRC_LINE = 2,              /* G01 */
  TRC_CLOCKWISE = 3,         /* G02, seen from the positive third axis */
  TRC_COUNTER_CLOCKWISE = 4, /* G03 */
  TRC_TEXT = 5,              /* no motion: technology words, dwell; comes out in its place */
  /* These are fed only. Selection and deselection act with the next motion. */
  TRC_LEFT = 6,   /* G41: the tool left of the contour, seen along the travel */
  TRC_RIGHT = 7,  /* G42 */
  TRC_OFF = 8,    /* G40 */
  TRC_COMMAND = 9 /* any change, in `text`: JSON of the message TrcCommand of block.proto */
};

/* Which members of a trc_block are given, as a sum. */
enum trc_given {
  TRC_HAS_X = 1,
  TRC_HAS_Y = 2,
  TRC_HAS_Z = 4,
  TRC_HAS_I = 8,
  TRC_HAS_J = 16,
  TRC_HAS_K = 32,
  TRC_HAS_RADIUS = 64, /* of arcs, in place of i, j and k */
  TRC_HAS_FEED = 128,
  TRC_HAS_NUMBER = 256
};

/* Whether a block bounds material. */
enum trc_role {
  TRC_ROLE_OF_SETUP = 0, /* as the setting `leads` says */
  TRC_ROLE_WALL = 1,     /* the path keeps clear of it */
  TRC_ROLE_LEAD = 2      /* lead-in, lead-out or overrun: no wall */
};

/* Where a tracking axis (`axis_names` of the setup) goes. */
typedef struct trc_axis {
  uint32_t axis;     /* place in `axis_names`, from 0: A B C U V W unless the setup says so */
  uint32_t reserved; /* 0 */
  double position;   /* absolute; mm or degrees as the axis has it, -1e6 to 1e6 */
} trc_axis;

/* One block of the programmed path. Members that `given` does not name are not read. */
typedef struct trc_block {
  int32_t kind;   /* enum trc_kind; 0 is refused */
  uint32_t given; /* a sum of enum trc_given */
  double x, y, z; /* end point, absolute, mm; not given: as before. An arc that ends where it
                     starts is a full circle, one with travel across the plane a helix. */
  double i, j, k; /* centre of an arc, mm: from the start point unless the setup or a command says
                     absolute; not given: 0 from the start point */
  double radius;  /* mm, not 0; positive: the arc of at most 180 degrees, negative: the larger.
                     Not for full circles (20034). */
  double feed;    /* mm/min, above 0 to 1e9; not given: as before */
  int64_t number; /* N number, not negative */
  int32_t role;   /* enum trc_role */
  uint32_t axis_count;
  const trc_axis* axes; /* each axis at most once; not named: as before */
  const char* text;     /* TRC_TEXT: at most 65536 bytes without control characters; TRC_COMMAND */
} trc_block;

/* Why a block is on the compensated path. */
enum trc_origin {
  TRC_PROGRAMMED = 1,       /* a contour block, shortened or extended */
  TRC_APPROACH = 2,         /* selection motion, with what its mode inserts */
  TRC_RETRACT = 3,          /* deselection motion, likewise */
  TRC_TRANSITION = 4,       /* inserted at an outside corner or a joint */
  TRC_MASKED = 5,           /* programmed, not travelled: no motion */
  TRC_RADIUS_CHANGE = 6,    /* inserted because the tool radius changes */
  TRC_KERF = 7,             /* a contour block whose end KERF_MASKING has moved */
  TRC_CONVERTED_CIRCLE = 8, /* the chord that CONV_CIR_TO_LIN put in place of a circle */
  TRC_PASSTHROUGH = 9,      /* text */
  TRC_UNCOMPENSATED = 10    /* motion while the compensation is off */
};

/* One block of the compensated path. Joints are shared: the end of a block is the start of the next
 * one that moves, bit for bit. */
typedef struct trc_motion {
  size_t size;
  int32_t kind;       /* enum trc_kind: TRC_RAPID to TRC_TEXT */
  int32_t origin;     /* enum trc_origin */
  int32_t plane;      /* 17 (XY), 18 (ZX) or 19 (YZ) */
  int32_t tangential; /* 1: the joint with the block before counts as tangential */
  double start[3];    /* X Y Z of the tool centre, mm */
  double end[3];
  double center[3]; /* of arcs, absolute; across the plane that of the start point; else 0 */
  double sweep;     /* rad, positive: counter-clockwise, at most 2 pi in size; lines: 0 */
  double feed;      /* at the tool centre, mm/min; 0: none was programmed */
  uint64_t index;   /* block, or line with words, that it comes from, from 0 */
  int64_t number;   /* N number of that; -1: none */
  uint32_t line;    /* of NC text, from 1; 0: it did not come from text */
  uint32_t axis_count;
  const double* axis_start; /* of each tracking axis; none unless one has been programmed */
  const double* axis_end;
  const char* text; /* what came in with TRC_TEXT; "": none */
} trc_motion;

enum trc_severity { TRC_NOTE = 0, TRC_WARNING = 1, TRC_ERROR = 2 };

/* A number that a diagnostic speaks of. */
typedef struct trc_value {
  const char* name; /* as documented with the code */
  double value;     /* mm, degrees or a count, as the name says */
} trc_value;

/* What was found in a program or path. */
typedef struct trc_diagnostic {
  size_t size;
  int32_t code;       /* stable; trc explain CODE tells all about it */
  int32_t severity;   /* enum trc_severity */
  uint64_t index;     /* block, or line with words, from 0 */
  int64_t number;     /* N number; -1: none */
  uint32_t line;      /* of NC text, from 1; 0: it did not come from text */
  uint32_t column;    /* byte of the line, from 1; 0: not known */
  const char* reason; /* UPPER_SNAKE */
  const char* title;  /* what kind of thing it is */
  const char* text;   /* what is wrong, with the numbers, in the `language` of the setup */
  const char* help;   /* what can be done, likewise */
  const char* detail; /* the word or field at fault, as written; "": none */
  const trc_value* values;
  uint32_t value_count;
  int32_t has_point;
  double point[3]; /* X Y Z, mm, where `has_point` is 1 */
} trc_diagnostic;

enum trc_answer_kind {
  TRC_ANSWER_TEXT = 1,      /* NC text, any stretch of it */
  TRC_ANSWER_MOTION = 2,    /* one compensated block */
  TRC_ANSWER_DIAGNOSTIC = 3 /* after all that was certain in the line or block it is about */
};

/* The next of what a session says. What it points at holds until the next call with the session. */
typedef struct trc_answer {
  size_t size;   /* sizeof(trc_answer) */
  int32_t kind;  /* enum trc_answer_kind; what belongs to another kind is NULL and 0 */
  uint32_t zero; /* 0 */
  const char* text;
  size_t text_length; /* bytes */
  const trc_motion* motion;
  const trc_diagnostic* diagnostic;
} trc_answer;

/* What a finished session has done. */
typedef struct trc_summary {
  size_t size; /* sizeof(trc_summary) */
  uint64_t blocks_in;
  uint64_t blocks_out;
  uint64_t masked;      /* of blocks_out: programmed, not travelled */
  uint64_t transitions; /* of blocks_out: inserted at corners */
  uint64_t lines_in;    /* of NC text */
  uint64_t notes;
  uint64_t warnings;
  double programmed_length;  /* mm, in the plane */
  double compensated_length; /* mm, in the plane */
  double effective_radius;   /* that the tool cuts with at the end, mm */
  /* Of the measurement that the setting `verify` asks for; 0 without it. */
  uint64_t checked; /* blocks of the path that were measured */
  uint64_t gouging; /* of these, nearer to the contour than the tool radius */
  double clearance; /* the smallest one against its radius, mm; negative: behind the contour */
  double required;  /* the tool radius there, mm */
  double clearance_at[3];  /* X Y Z, mm */
  uint64_t clearance_wall; /* the contour block there, from 0 */
} trc_summary;

/* The version of the library, "major.minor.patch". Never NULL. */
TRC_API const char* trc_version(void);

/* What was wrong with the last call in this thread that gave neither TRC_OK nor TRC_END: a sentence
 * of at most 1023 bytes, with place and remedy; "" before. Holds until the next such call in this
 * thread. Never NULL. */
TRC_API const char* trc_last_error(void);

/* Begins a session and puts it into *session; NULL there unless it gives TRC_OK. TRC_ARGUMENT: a
 * setting, a field of the JSON or a value is wrong: trc_last_error names it and what is allowed. */
TRC_API int trc_create(const trc_setup* setup, trc_session** session);

/* Takes NC text, cut anywhere, also inside a word or a character: the answers are the same. `text`
 * needs no NUL and may be NULL where `length` is 0. TRC_REFUSED: the program is refused, now or
 * before; there is no use in feeding on. TRC_ORDER: a session of blocks, or one that is finished.
 */
TRC_API int trc_feed_text(trc_session* session, const char* text, size_t length);

/* Takes `count` blocks that lie `block_size` bytes apart: sizeof(trc_block). `blocks` may be NULL
 * where `count` is 0. What they point at is not needed afterwards. TRC_ARGUMENT: trc_last_error
 * names the block, counted from 0 since the start of the path, and the member; the blocks before it
 * have been taken, it and those after it have not, and the path may go on with a corrected one.
 * TRC_REFUSED, TRC_ORDER: as of trc_feed_text. */
TRC_API int trc_feed_blocks(trc_session* session, const trc_block* blocks, size_t count,
                            size_t block_size);

/* The end of the text or path: all that was held back comes out. Called again it gives the same
 * again. TRC_REFUSED: the program or path is refused. */
TRC_API int trc_finish(trc_session* session);

/* Fills in the next answer, in the order of the program. TRC_END: there is none for now. Answers
 * are kept until they are taken; after a TRC_REFUSED, too. */
TRC_API int trc_next(trc_session* session, trc_answer* answer);

/* What the session has done. Nothing may be machined before this gave TRC_OK: TRC_ORDER before
 * trc_finish, TRC_REFUSED where the program or path was refused, filled in up to there. */
TRC_API int trc_summarize(const trc_session* session, trc_summary* summary);

/* Ends a session at any time, and all that its answers point at. NULL: nothing. */
TRC_API void trc_free(trc_session* session);

/* NOLINTEND(readability-identifier-naming,modernize-*) */
#ifdef __cplusplus
}
#endif

#endif
