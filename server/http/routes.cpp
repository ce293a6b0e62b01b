#include <array>

#include "server/http/api.h"
#include "server/http/handlers.h"

namespace trc::server::http {
namespace {

constexpr auto survey_questions = std::to_array<Question>(
    {{"radii", Question::Kind::text, "mm: 3,5,8 or 3:8:0.5, from, to and step; 64 at most"},
     {"uncut", Question::Kind::text, "true: what each radius leaves uncut"},
     {"largest", Question::Kind::text, "false: without the largest radius that fits"}});
constexpr auto view_questions = std::to_array<Question>(
    {{"shown_plane", Question::Kind::text,
      "xy, zx, yz: seen across that plane; by default that of the first compensated block"}});
constexpr auto tile_questions = std::to_array<Question>(
    {{"segments", Question::Kind::number, "at most, 256 to 16384; 2048 without it"}});
constexpr auto lines_questions =
    std::to_array<Question>({{"from", Question::Kind::number, "the first line, from 1"},
                             {"count", Question::Kind::number, "of lines, 200 without it"}});
constexpr auto blocks_questions =
    std::to_array<Question>({{"line", Question::Kind::number, "of the program, from 1"}});
constexpr auto place_questions =
    std::to_array<Question>({{"share", Question::Kind::share, "of the way, 0 to 1"}});
constexpr auto page_questions =
    std::to_array<Question>({{"offer", Question::Kind::text, "the program that `trc view` shows"}});

constexpr std::array<Route, 20> table{{
    {.method = "POST",
     .path = "/v1/programs:compensate",
     .body = Body::program,
     .takes_settings = true,
     .answers = "text/plain,application/x-ndjson",
     .meaning = "Compensates an NC program: NC text in, NC text with TRC resolved out, or the path "
                "as JSON lines",
     .handle = compensate_program},
    {.method = "POST",
     .path = "/v1/programs:verify",
     .body = Body::program,
     .takes_settings = true,
     .answers = "application/json",
     .meaning = "Compensates an NC program and measures the path against the contour",
     .handle = verify_program},
    {.method = "POST",
     .path = "/v1/programs:record",
     .body = Body::program,
     .takes_settings = true,
     .answers = "application/json",
     .meaning = "Compensates an NC program and tells what was made of which bytes, and how it was "
                "measured: a JobRecord, as `trc verify --record` takes it",
     .handle = record_program},
    {.method = "POST",
     .path = "/v1/programs:surveyRadii",
     .body = Body::program,
     .takes_settings = true,
     .answers = "application/json",
     .meaning = "Says what tools of many radii make of an NC program: `radii` (3,5,8 or 3:8:0.5), "
                "`uncut`, `largest`; a SurveyAnswer",
     .handle = survey_program,
     .questions = survey_questions},
    {.method = "POST",
     .path = "/v1/paths:compensate",
     .body = Body::message,
     .answers = "application/json,application/x-ndjson",
     .meaning = "Compensates a path of motion blocks: a PreviewPathRequest in, a PathAnswer out, "
                "or JSON lines",
     .handle = compensate_path},
    {.method = "POST",
     .path = "/v1/paths:verify",
     .body = Body::message,
     .answers = "application/json",
     .meaning = "Compensates a path and measures it against the contour, as `setup.verify` says: "
                "VERIFICATION_ENFORCE, so without it, or VERIFICATION_REPORT",
     .handle = verify_path},
    {.method = "POST",
     .path = "/v1/paths:surveyRadii",
     .body = Body::message,
     .answers = "application/json",
     .meaning =
         "Says what tools of many radii make of a path: a SurveyPathRequest in, a SurveyAnswer out",
     .handle = survey_path},
    {.method = "POST",
     .path = "/v1/views",
     .body = Body::program,
     .takes_settings = true,
     .answers = "application/json",
     .meaning = "Keeps a program and its path to be looked at: a View",
     .handle = make_view,
     .questions = view_questions},
    {.method = "GET",
     .path = "/v1/views/{id}",
     .answers = "application/json",
     .meaning = "The View again",
     .handle = view_said},
    {.method = "DELETE",
     .path = "/v1/views/{id}",
     .meaning = "Gives a view up",
     .handle = remove_view},
    {.method = "GET",
     .path = "/v1/views/{id}/tiles/{level}/{x}/{y}",
     .answers = "application/octet-stream",
     .meaning = "A square of the picture as segments",
     .handle = view_tile,
     .questions = tile_questions},
    {.method = "GET",
     .path = "/v1/views/{id}/lines",
     .answers = "application/json",
     .meaning = "Lines of the program, `from` and `count`: ViewLines",
     .handle = view_lines,
     .questions = lines_questions},
    {.method = "GET",
     .path = "/v1/views/{id}/output",
     .answers = "application/json",
     .meaning = "Lines of the compensated program: ViewLines",
     .handle = view_output,
     .questions = lines_questions},
    {.method = "GET",
     .path = "/v1/views/{id}/blocks",
     .answers = "application/json",
     .meaning = "The blocks of the line `line`: ViewBlocks",
     .handle = view_blocks,
     .questions = blocks_questions},
    {.method = "GET",
     .path = "/v1/views/{id}/place",
     .answers = "application/json",
     .meaning = "Where the tool is after `share` of its way: ViewPlace",
     .handle = view_place,
     .questions = place_questions},
    {.method = "GET",
     .path = "/v1/offers/{token}",
     .answers = "application/octet-stream",
     .meaning = "The program that `trc view` shows, with its name and settings as headers",
     .handle = offered_program},
    {.method = "GET",
     .path = "/",
     .answers = "text/html",
     .meaning = "The page",
     .handle = page_start,
     .questions = page_questions},
    {.method = "GET",
     .path = "/page/{file}",
     .answers = "text/javascript,text/css",
     .meaning = "Its parts",
     .handle = page_file},
    {.method = "GET",
     .path = "/v1/info",
     .answers = "application/json",
     .meaning =
         "Version, limits, settings, options, functions and diagnostics: GetServerInfoResponse",
     .handle = server_info},
    {.method = "GET",
     .path = "/v1/openapi.json",
     .answers = "application/json",
     .meaning = "This document",
     .handle = open_api},
}};

}  // namespace

std::span<const Route> routes() { return table; }

}  // namespace trc::server::http
