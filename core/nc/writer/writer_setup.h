#pragma once

#include "core/nc/dialect/dialect.h"
#include "core/nc/state/program_setup.h"
#include "core/nc/writer/nc_writer.h"

namespace trc {

// How a program of that setup is written in `dialect`, its own or another one.
[[nodiscard]] NcWriter::Setup writer_setup(const ProgramSetup& program, const Dialect& dialect);

}  // namespace trc
