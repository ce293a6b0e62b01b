/* compensate FILE [KEY=VALUE ...]: the program with TRC resolved on standard output, diagnostics on
 * standard error, as the command line does it with --set KEY=VALUE. Of an installed libtrc:
 *
 *   cc compensate.c $(pkg-config --cflags --libs trc) -o compensate
 */
#include <stdio.h>
#include <trc.h>

/* All that is certain by now. */
static int write_answers(trc_session* session) {
  static const char* const severities[] = {"note", "warning", "error"};
  trc_answer answer = {.size = sizeof answer};
  int status;
  while ((status = trc_next(session, &answer)) == TRC_OK) {
    if (answer.kind == TRC_ANSWER_TEXT) fwrite(answer.text, 1, answer.text_length, stdout);
    if (answer.kind == TRC_ANSWER_DIAGNOSTIC)
      fprintf(stderr, "line %lu: %s %d: %s\n", (unsigned long)answer.diagnostic->line,
              severities[answer.diagnostic->severity],
              (int)answer.diagnostic->code, answer.diagnostic->text);
  }
  return status == TRC_END ? TRC_OK : status;
}

int main(int argc, char** argv) {
  trc_setup setup = {.size = sizeof setup, .input = TRC_INPUT_TEXT};
  trc_session* session = NULL;
  FILE* program = argc > 1 ? fopen(argv[1], "rb") : NULL;
  char piece[8192];
  size_t length;
  int status;
  int told;

  if (program == NULL) {
    fprintf(stderr, "usage: compensate FILE [KEY=VALUE ...]\n");
    return 2;
  }
  setup.settings = (const char* const*)(argv + 2);
  setup.setting_count = (uint32_t)(argc - 2);
  status = trc_create(&setup, &session);
  while (status == TRC_OK && (length = fread(piece, 1, sizeof piece, program)) > 0) {
    status = trc_feed_text(session, piece, length);
    if (status == TRC_OK) status = write_answers(session);
  }
  if (status == TRC_OK) status = trc_finish(session);
  if (status != TRC_OK && status != TRC_REFUSED)
    fprintf(stderr, "compensate: %s\n", trc_last_error());
  if (session != NULL) {
    told = write_answers(session);
    if (status == TRC_OK) status = told;
  }
  trc_free(session);
  fclose(program);
  return status == TRC_OK ? 0 : status == TRC_REFUSED ? 1 : 2;
}
