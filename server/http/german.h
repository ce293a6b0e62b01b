#pragma once

#include "trc/v1/http.pb.h"

namespace trc::server::http {

// Title, detail and fields of a problem in German. Texts about a program are so already, in the
// language of its setup.
void make_german(v1::Problem& problem);

}  // namespace trc::server::http
