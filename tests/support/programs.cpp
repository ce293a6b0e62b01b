#include "tests/support/process.h"

namespace trc::testing_support {

std::string trc_program() { return TRC_PROGRAM; }
std::string trcd_program() { return TRCD_PROGRAM; }

}  // namespace trc::testing_support
