#pragma once

#include <algorithm>
#include <concepts>
#include <span>
#include <utility>
#include <vector>

#include "core/base/checkpoint.h"

namespace trc {

// A pass reads one stream of blocks and writes another.
//
//   feed(item, out)  takes one item, appends to `out` all that has become certain
//   drain(out)       no more items: appends all that was held back
//
// feed and drain return false once the stream must stop; Diagnostics then says why. Certain means:
// no later block can change it any more. Nothing in `out` is ever patched. The comment at the head
// of each pass says what it holds back.
template <class P, class In, class Out>
concept Pass = requires(P pass, In item, std::vector<Out>& out) {
  { pass.feed(std::move(item), out) } -> std::same_as<bool>;
  { pass.drain(out) } -> std::same_as<bool>;
};

// A pass that may release a whole selection at once. The selection leaves in portions, so that the
// vectors between the passes need not hold all of it.
//
//   feed(item, out)    as of a Pass; what is fed while a selection is leaving waits behind it
//   end()              no more items: what was held back begins to leave
//   is_leaving()       release_some() has more to append, before the passes after it may drain
//   release_some(out)  appends a portion
//
// All but is_leaving return false once the stream must stop.
template <class P, class In, class Out>
concept ReleasingPass = requires(P pass, const P& view, In item, std::vector<Out>& out) {
  { pass.feed(std::move(item), out) } -> std::same_as<bool>;
  { pass.end() } -> std::same_as<bool>;
  { view.is_leaving() } -> std::same_as<bool>;
  { pass.release_some(out) } -> std::same_as<bool>;
};

template <class P, class In, class Out>
concept AnyPass = Pass<P, In, Out> || ReleasingPass<P, In, Out>;

// A pass that seldom has work tells which blocks it ignores in its present state: it lets them pass
// unchanged, and holds nothing that they would have to wait for.
template <class P, class Owner>
concept IdlePass = requires(const P& view, const Owner& owner) {
  { view.ignores(*owner) } -> std::same_as<bool>;
};

// A pass that needs no neighbour: it looks at each block once, where it lies.
template <class P, class Owner>
concept InPlacePass = requires(P pass, Owner& owner) {
  { pass.apply(*owner) } -> std::same_as<bool>;
};

enum class Input { more, ended };

template <class P, class In, class Out>
requires AnyPass<P, In, Out>
[[nodiscard]] bool advance(P& pass, std::span<In> in, std::vector<Out>& out, Input input,
                           Checkpoint& checkpoint) {
  for (In& item : in) {
    checkpoint.pass();
    if (!pass.feed(std::move(item), out)) return false;
  }
  if (input == Input::more) return true;
  if constexpr (Pass<P, In, Out>)
    return pass.drain(out);
  else
    return pass.end();
}

template <class P, class In, class Out>
requires AnyPass<P, In, Out>
[[nodiscard]] bool advance(P& pass, std::vector<In>& in, std::vector<Out>& out, Input input,
                           Checkpoint& checkpoint) {
  const bool goes_on = advance(pass, std::span(in), out, input, checkpoint);
  in.clear();
  return goes_on;
}

// The blocks between two passes of one kind of blocks: each pass takes them out and puts its
// results in their place.
template <class Owner>
struct OnTheWay {
  std::vector<Owner> blocks{};
  std::vector<Owner> taken{};  // by the pass at work; empty else
};

template <class P, class Owner>
[[nodiscard, gnu::noinline]] bool work(P& pass, OnTheWay<Owner>& way, Input input,
                                       Checkpoint& checkpoint) {
  way.taken.swap(way.blocks);
  return advance(pass, way.taken, way.blocks, input, checkpoint);
}

// A block that an idle pass ignores stays where it is, as nearly every block does; the other cases
// are kept out of that fast path.
template <class P, class Owner>
requires AnyPass<P, Owner, Owner>
[[nodiscard]] inline bool advance(P& pass, OnTheWay<Owner>& way, Input input,
                                  Checkpoint& checkpoint) {
  bool works = input == Input::ended || !IdlePass<P, Owner>;
  if constexpr (IdlePass<P, Owner>)
    for (const Owner& block : way.blocks) works = works || !pass.ignores(*block);
  return !works || work(pass, way, input, checkpoint);
}

template <class P, class Owner>
requires InPlacePass<P, Owner>
[[nodiscard]] bool apply(P& pass, std::vector<Owner>& blocks) {
  for (Owner& block : blocks)
    if (!pass.apply(*block)) return false;
  return true;
}

}  // namespace trc
