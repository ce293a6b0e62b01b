#if defined(__SANITIZE_THREAD__)

// The distribution's gRPC is not built for ThreadSanitizer, so the sanitizer does not see how it
// orders one callback after another, and takes every message handed over for a race, and every
// handshake that goes on in another thread than it began in. Races between
// our own threads are found all the same: they meet in locks of ours. What is ignored by the
// library that calls costs nothing, what is ignored by a name in the stack a look at all symbols
// each time. A connection is let go of by the thread of gRPC that ends its last call, after that
// of the turn that has looked at it.
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libgrpc.so\n"
         "called_from_lib:libgrpc++.so\n"
         "called_from_lib:libabsl_strings.so\n"
         "race:grpc::\n"
         "race:grpc_core::\n"
         "race:libgrpc.so\n"
         "race:libgpr.so\n"
         "race:libabsl_\n"
         "race:google::protobuf\n"
         "race:trc::server::Connections::forget_gone\n"
         "called_from_lib:libssl.so\n"
         "called_from_lib:libcrypto.so\n";
}

#endif

#if defined(__SANITIZE_ADDRESS__)

// Looking up a name leaves some bytes behind in the distribution's c-ares.
extern "C" const char* __lsan_default_suppressions() { return "leak:libcares.so\n"; }

#endif
