#pragma once

#include "client/plot/picture.h"

namespace trc::plot {

// Adds warnings, the error and the proposals for it to a picture.
void add_findings(const Contents& contents, Picture& picture);

}  // namespace trc::plot
