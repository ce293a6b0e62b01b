#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "proto/wire/json.h"
#include "server/http/api.h"
#include "server/http/handlers.h"
#include "server/http/problem.h"
#include "server/http/program_questions.h"
#include "server/http/settings.h"
#include "server/http/view/store.h"
#include "server/http/view/view_builder.h"
#include "server/http/view/view_memory.h"
#include "server/http/view/view_tap.h"
#include "server/rpc/setup.h"

namespace trc::server::http {
namespace {

constexpr const char* compensate_program_rpc = "/trc.v1.TrcService/CompensateProgram";

v1::Problem no_memory() {
  return problem(503, "HTTP_MEMORY_LIMIT", "A limit of the server is reached",
                 "the view takes more memory than the setting http-max-memory-mib leaves; close "
                 "other views or try again later");
}

v1::Problem no_output() {
  return problem(
      503, "HTTP_MEMORY_LIMIT", "A limit of the server is reached",
      "the compensated text takes more memory than the setting http-max-memory-mib "
      "leaves; get it with POST /v1/programs:compensate, which sends it while it is made");
}

v1::Problem no_view() {
  return problem(404, "VIEW_GONE", "There is no such view",
                 "views are given up when there are too many or after a while; make a new one");
}

// Thrown out of work for a view when the server is stopping.
struct Stopping {};

// What such work in a worker calls from time to time.
std::function<void()> passing(Api& api) {
  return [&api] {
    if (api.stopping()) throw Stopping{};
    api.backend().pool.give_way();
  };
}

// Makes a view from the answers of CompensateProgram. A refused program becomes a view as well: its
// user looks at it all the more.
class ViewFormat final : public Format, public std::enable_shared_from_this<ViewFormat> {
 public:
  ViewFormat(Api& api, std::shared_ptr<ViewBuilder> builder, std::shared_ptr<ViewTap> tap)
      : api_(api), builder_(std::move(builder)), tap_(std::move(tap)) {}
  ~ViewFormat() override { tap_->close(); }
  ViewFormat(const ViewFormat&) = delete;
  ViewFormat& operator=(const ViewFormat&) = delete;

  [[nodiscard]] Head head() const override {
    return {.status = said_.empty() ? 503U : 201U,
            .content_type = said_.empty() ? "application/problem+json" : "application/json"};
  }

  bool take(const grpc::ByteBuffer& answer, std::string& /*out*/) override {
    using Answer = v1::CompensateProgramResponse;
    try {
      if (!RpcCall::read_message(answer, answer_)) return false;
      for (const v1::Diagnostic& diagnostic : answer_.diagnostics()) builder_->add(diagnostic);
      if (answer_.response_case() == Answer::kSummary) builder_->set_summary(answer_.summary());
    } catch (const std::bad_alloc&) {
      builder_->lose_memory();
    }
    return builder_->has_memory();
  }

  void close(std::string& out) override {
    if (const auto refused = make())
      out += wire::json_of(*refused);
    else
      out += said_;
    out += '\n';
  }

  void refuse(const ExchangePointer& exchange, const grpc::Status& status) override {
    // The stream was ended because the view found no memory.
    if (!builder_->has_memory()) return answer_problem(*exchange, no_memory());
    const v1::Problem problem = problem_of(status);
    constexpr unsigned refused_program = 422;
    if (problem.status() != refused_program) return answer_problem(*exchange, problem);
    builder_->set_refused();
    api_.compute([self = shared_from_this(), exchange] {
      std::string body;
      self->close(body);
      exchange->post([self, exchange, body = std::move(body)]() mutable {
        exchange->answer(self->head(), std::move(body));
      });
    });
  }

  bool stop(const grpc::Status& /*status*/, std::string& /*out*/) override { return false; }
  [[nodiscard]] bool streams() const override { return false; }

 private:
  // Returns why there is no view.
  std::optional<v1::Problem> make() {
    try {
      tap_->finish();
      const auto view = builder_->finish(ViewStore::new_id(), passing(api_));
      if (view == nullptr) return no_memory();
      said_ = wire::json_of(view->said());
      api_.views().add(view);
      return std::nullopt;
    } catch (const Stopping&) {
      return problem_of(server::refuse(Refusal::draining).status);
    } catch (const std::bad_alloc&) {
      return no_memory();
    }
  }

  Api& api_;
  std::shared_ptr<ViewBuilder> builder_;
  std::shared_ptr<ViewTap> tap_;
  v1::CompensateProgramResponse answer_;
  std::string said_;
};

// The view that a path names; asking for it extends its life.
std::shared_ptr<View> view_of(Api& api, const Request& request) {
  constexpr std::string_view before = "/v1/views/";
  const std::string_view rest = std::string_view(request.path).substr(before.size());
  return api.views().find(std::string(rest.substr(0, rest.find('/'))));
}

std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

std::uint64_t number_in(const Pairs& query, std::string_view name, std::uint64_t otherwise) {
  for (const auto& [key, value] : query)
    if (key == name) return whole_number(value).value_or(otherwise);
  return otherwise;
}

// Has a worker do `work`, which answers; where the heap has nothing left for it, that is the
// answer.
template <class Work>
void compute_answer(Api& api, const ExchangePointer& exchange, const Work& work) {
  api.compute([exchange, work] {
    try {
      const HeapReserve::Turn reserve;
      work();
    } catch (const std::bad_alloc&) {
      exchange->post([exchange] { answer_problem(*exchange, no_memory()); });
    }
  });
}

// Answers with the message that a worker makes from the view with `make`.
template <class Make>
void answer_of_view(Api& api, const ExchangePointer& exchange, const Make& make) {
  const auto view = view_of(api, exchange->request());
  if (view == nullptr) return answer_problem(*exchange, no_view());
  compute_answer(api, exchange, [exchange, view, make] {
    std::string body = wire::json_of(make(*view, exchange->request())) + "\n";
    exchange->post([exchange, body = std::move(body)]() mutable {
      exchange->answer({.content_type = "application/json"}, std::move(body));
    });
  });
}

// Makes the compensated text, once, and stops when nobody can ask for it any more.
void make_output_of(Api& api, const std::shared_ptr<View>& view) {
  if (view->said().refused() || !view->begin_output()) return;
  struct Abandoned {};
  api.compute_in_background([&api, view] {
    const auto pass = [&] {
      if (view->is_given_up() || api.stopping()) throw Abandoned{};
      api.background().give_way();
    };
    try {
      view->make_output(pass, [&] { return api.views().give_up_one(view.get()); });
    } catch (const Abandoned&) {
    }
  });
}

// The tile of a path …/tiles/LEVEL/X/Y; none: no such tile.
std::optional<TileName> tile_named(std::string_view path) {
  std::array<std::uint64_t, 3> numbers{};
  for (std::size_t i = numbers.size(); i-- > 0;) {
    const std::size_t slash = path.rfind('/');
    const auto number = whole_number(path.substr(slash + 1));
    if (!number) return std::nullopt;
    numbers[i] = *number;
    path = path.substr(0, slash);
  }
  const auto [level, x, y] = numbers;
  if (level > most_level || std::max(x, y) >= std::uint64_t{1} << level) return std::nullopt;
  return TileName{.level = static_cast<std::uint32_t>(level),
                  .x = static_cast<std::uint32_t>(x),
                  .y = static_cast<std::uint32_t>(y)};
}

struct AskedView {
  ViewedProgram program{};
  v1::ProgramSetup setup{};
  bool measured_later = false;
  std::atomic<bool> is_wanted = true;  // its client waits
};

void start_view(Api& api, const ExchangePointer& exchange, AskedView& asked) {
  const Api::Stay stay(api);
  if (api.stopping() || !asked.is_wanted) return exchange->break_off();
  const auto text = asked.program.text;
  // Older views are given up for a new one.
  auto builder = std::make_shared<ViewBuilder>(std::move(asked.program), api.memory(),
                                               [&api] { return api.views().give_up_one(); });
  if (asked.measured_later) builder->measure_later();
  auto tap = std::make_shared<ViewTap>(
      builder,
      ViewTap::Help{.compute = [&api](std::function<void()> work) { api.compute(std::move(work)); },
                    .pass = [&api] { api.backend().pool.give_way(); }});
  const std::string name = ViewStore::new_id();
  api.backend().run_taps.add(name, tap);
  RpcExchange::start(
      api, exchange, {.method = compensate_program_rpc, .run_tap = name},
      std::make_unique<ProgramQuestions>(asked.setup, text, api.most_message_bytes()),
      std::make_shared<ViewFormat>(api, std::move(builder), std::move(tap)));
}

// Takes the first look, as long as it is wanted. Throws std::bad_alloc where there is no memory.
void look_at(Api& api, ViewedProgram& program, const std::atomic<bool>& is_wanted) {
  struct Unwanted {};
  ViewMemory memory(api.memory());
  const ViewMemory::MakeRoom make_room = [&api] { return api.views().give_up_one(); };
  ViewMemory::Turn turn(memory, make_room);
  try {
    program.look = first_look(*program.text, program.settings.path.session, [&] {
      if (!is_wanted || api.stopping()) throw Unwanted{};
      turn.check();
      api.backend().pool.give_way();
    });
  } catch (const Unwanted&) {
    // Nothing starts then.
  }
}

// Takes the shown plane from the query; false: the value is no plane.
bool take_plane(Pairs& query, std::optional<Plane>& plane) {
  const auto asked = std::ranges::find(query, "shown_plane", &Pairs::value_type::first);
  if (asked == query.end()) return true;
  constexpr std::array<std::pair<std::string_view, Plane>, 3> planes{
      {{"xy", Plane::xy}, {"zx", Plane::zx}, {"yz", Plane::yz}}};
  for (const auto& [name, meant] : planes)
    if (asked->second == name) plane = meant;
  query.erase(asked);
  return plane.has_value();
}

}  // namespace

void make_view(Api& api, const ExchangePointer& exchange) {
  v1::ProgramSetup setup;
  setup.mutable_path()->set_verify(v1::VERIFICATION_REPORT);
  Pairs query = exchange->request().query;
  std::optional<Plane> plane;
  if (!take_plane(query, plane))
    return answer_problem(*exchange, problem(400, "SETTING_INVALID",
                                             "A query parameter is no setting that can be taken",
                                             "shown_plane: it takes xy, zx, yz"));
  if (const auto refused =
          read_settings(query, exchange->request().header("accept-language"), setup))
    return answer_problem(*exchange, *refused);
  // Measuring takes longer than everything else.
  constexpr std::size_t large_bytes = 1U << 20U;
  const bool measured_later =
      exchange->request().body.size() > large_bytes &&
      std::none_of(query.begin(), query.end(), [](const auto& p) { return p.first == "verify"; });
  if (measured_later) setup.mutable_path()->set_verify(v1::VERIFICATION_OFF);
  setup.set_output(v1::PROGRAM_OUTPUT_BLOCKS);
  wire::ProgramSettings settings;
  if (const auto refused = read_setup(setup, api.backend().config, settings))
    return answer_problem(*exchange, problem_of(refused->status));
  const auto asked = std::make_shared<AskedView>();
  asked->program = {.text = exchange->request().take_body(),
                    .name = setup.file_name(),
                    .settings = std::move(settings),
                    .plane = plane};
  asked->setup = std::move(setup);
  asked->measured_later = measured_later;
  exchange->when_gone([asked] { asked->is_wanted = false; });
  compute_answer(api, exchange, [&api, exchange, asked] {
    look_at(api, asked->program, asked->is_wanted);
    exchange->post([&api, exchange, asked] { start_view(api, exchange, *asked); });
  });
}

void view_said(Api& api, const ExchangePointer& exchange) {
  if (const auto view = view_of(api, exchange->request()); view != nullptr)
    make_output_of(api, view);
  answer_of_view(api, exchange,
                 [](const View& view, const Request& /*request*/) { return view.said_by_now(); });
}

void remove_view(Api& api, const ExchangePointer& exchange) {
  const auto view = view_of(api, exchange->request());
  if (view == nullptr) return answer_problem(*exchange, no_view());
  api.views().remove(view->said().id());
  exchange->answer({.status = 204}, {});
}

void view_tile(Api& api, const ExchangePointer& exchange) {
  const auto view = view_of(api, exchange->request());
  if (view == nullptr) return answer_problem(*exchange, no_view());
  const auto tile = tile_named(exchange->request().path);
  if (!tile)
    return answer_problem(*exchange, problem(404, "TILE_OUTSIDE", "There is no such tile",
                                             "levels and tiles are counted from 0"));
  // A client with a large screen and many tiles can ask for fewer segments per tile.
  constexpr std::uint64_t usual = 2048;
  const auto segments = static_cast<std::size_t>(std::clamp<std::uint64_t>(
      number_in(exchange->request().query, "segments", usual), 256, 16'384));
  compute_answer(api, exchange, [exchange, view, tile, segments] {
    std::string drawn = view->tile(*tile, segments);
    exchange->post([exchange, drawn = std::move(drawn)]() mutable {
      exchange->answer({.content_type = "application/octet-stream",
                        .headers = {{"Cache-Control", "private, max-age=3600, immutable"}}},
                       std::move(drawn));
    });
  });
}

void view_lines(Api& api, const ExchangePointer& exchange) {
  answer_of_view(api, exchange, [](const View& view, const Request& request) {
    return view.program().some(number_in(request.query, "from", 1),
                               number_in(request.query, "count", 200));
  });
}

void view_output(Api& api, const ExchangePointer& exchange) {
  const auto view = view_of(api, exchange->request());
  if (view != nullptr) make_output_of(api, view);
  if (view != nullptr && view->lacks_output()) return answer_problem(*exchange, no_output());
  answer_of_view(api, exchange, [](const View& of, const Request& request) {
    v1::ViewLines lines;
    const auto output = of.output();
    if (output != nullptr)
      lines =
          output->some(number_in(request.query, "from", 1), number_in(request.query, "count", 200));
    lines.set_refused(of.said().refused());
    lines.set_pending(output == nullptr && !of.said().refused());
    return lines;
  });
}

void view_blocks(Api& api, const ExchangePointer& exchange) {
  answer_of_view(api, exchange, [](const View& view, const Request& request) {
    return view.blocks_of_line(number_in(request.query, "line", 0));
  });
}

void view_place(Api& api, const ExchangePointer& exchange) {
  answer_of_view(api, exchange, [](const View& view, const Request& request) {
    double share = 0;
    for (const auto& [name, value] : request.query)
      if (name == "share") std::from_chars(value.data(), value.data() + value.size(), share);
    return view.place_at(std::clamp(share, 0.0, 1.0));
  });
}

}  // namespace trc::server::http
