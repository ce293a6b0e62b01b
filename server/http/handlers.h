#pragma once

#include "server/http/exchange.h"

namespace trc::server::http {

class Api;

// One for each route.
void compensate_program(Api& api, const ExchangePointer& exchange);
void verify_program(Api& api, const ExchangePointer& exchange);
void record_program(Api& api, const ExchangePointer& exchange);
void survey_program(Api& api, const ExchangePointer& exchange);
void compensate_path(Api& api, const ExchangePointer& exchange);
void verify_path(Api& api, const ExchangePointer& exchange);
void survey_path(Api& api, const ExchangePointer& exchange);
void make_view(Api& api, const ExchangePointer& exchange);
void view_said(Api& api, const ExchangePointer& exchange);
void remove_view(Api& api, const ExchangePointer& exchange);
void view_tile(Api& api, const ExchangePointer& exchange);
void view_lines(Api& api, const ExchangePointer& exchange);
void view_output(Api& api, const ExchangePointer& exchange);
void view_blocks(Api& api, const ExchangePointer& exchange);
void view_place(Api& api, const ExchangePointer& exchange);
void page_start(Api& api, const ExchangePointer& exchange);
void page_file(Api& api, const ExchangePointer& exchange);
void offered_program(Api& api, const ExchangePointer& exchange);
void server_info(Api& api, const ExchangePointer& exchange);
void open_api(Api& api, const ExchangePointer& exchange);

}  // namespace trc::server::http
