#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/base/checkpoint.h"

namespace trc {

// A pass reads one stream of blocks and writes another.
//
//   feed(item, out)  takes one item, appends to `out` all that has become certain
//   drain(out)       no more items: appends all that was held back
//   look_ahead()     the most items the pass ever holds back
//
// feed and drain return false once the stream must stop; Diagnostics then says
// why. Certain means: no later block can change it any more. Nothing in `out` is
// ever patched.
template <class P, class In, class Out>
concept Pass = requires(P pass, const P& view, In item, std::vector<Out>& out) {
  { pass.feed(std::move(item), out) } -> std::same_as<bool>;
  { pass.drain(out) } -> std::same_as<bool>;
  { view.look_ahead() } -> std::same_as<std::size_t>;
};

// A pass that is seldom at work says which blocks mean nothing to it as it stands: it lets them
// pass as they are, and holds nothing they would have to wait for.
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
requires Pass<P, In, Out>
[[nodiscard]] bool advance(P& pass, std::span<In> in, std::vector<Out>& out, Input input,
                           Checkpoint& checkpoint) {
  for (In& item : in) {
    checkpoint.pass();
    if (!pass.feed(std::move(item), out)) return false;
  }
  return input == Input::more || pass.drain(out);
}

template <class P, class In, class Out>
requires Pass<P, In, Out>
[[nodiscard]] bool advance(P& pass, std::vector<In>& in, std::vector<Out>& out, Input input,
                           Checkpoint& checkpoint) {
  const bool goes_on = advance(pass, std::span(in), out, input, checkpoint);
  in.clear();
  return goes_on;
}

// The blocks between two passes of one kind of blocks: each takes them out and puts what it makes
// of them in their place.
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

// What an idle pass ignores stays where it is, as nearly every block does; what happens else is
// kept out of the way of that.
template <class P, class Owner>
requires Pass<P, Owner, Owner>
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
