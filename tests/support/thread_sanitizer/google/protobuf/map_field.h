// Stands before Protobuf's header of this name in builds for ThreadSanitizer by g++.
//
// Protobuf 3.21 gives each map two more members when it is compiled for that sanitizer. The
// distribution's library is not, and would look for the other members where they are not: a
// message with a map dies as soon as the library frees it. So here, and here only, the header does
// not get to know of the sanitizer; what is compiled from it is watched all the same.

// What the header itself includes may know of it.
#include <google/protobuf/arena.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/generated_message_reflection.h>
#include <google/protobuf/generated_message_util.h>
#include <google/protobuf/map_entry.h>
#include <google/protobuf/map_field_lite.h>
#include <google/protobuf/map_type_handler.h>
#include <google/protobuf/message.h>
#include <google/protobuf/port.h>
#include <google/protobuf/repeated_field.h>
#include <google/protobuf/stubs/mutex.h>
#include <google/protobuf/unknown_field_set.h>

#include <atomic>
#include <functional>

#pragma push_macro("__SANITIZE_THREAD__")
#undef __SANITIZE_THREAD__
#include_next <google/protobuf/map_field.h>
#pragma pop_macro("__SANITIZE_THREAD__")
