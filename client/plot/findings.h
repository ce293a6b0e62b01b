#pragma once

#include "client/plot/picture.h"

namespace trc::plot {

// Puts warnings, the error and what is proposed in its place into a picture.
void add_findings(const Contents& contents, Picture& picture);

}  // namespace trc::plot
