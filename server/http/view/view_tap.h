#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "server/http/view/view_builder.h"
#include "server/http/view/view_queue.h"
#include "server/rpc/run_taps.h"

namespace trc::server::http {

// Takes contour and path of a view from the stream that compensates its program, and has another
// thread put them into the view while the stream goes on.
class ViewTap final : public RunTap, public std::enable_shared_from_this<ViewTap> {
 public:
  struct Help {
    // Lets another thread do some work, soon.
    std::function<void(std::function<void()>)> compute{};
    // Called now and then in that thread.
    std::function<void()> pass{};
  };
  ViewTap(std::shared_ptr<ViewBuilder> builder, Help help);

  void take_contour(std::span<const Block> blocks) override;
  void take_path(std::vector<CompensatedBlock>& blocks) override;
  // To be called once the stream has ended: puts in all that waits.
  void finish();
  // Nothing more is taken, and no other thread is asked: the client of the view is gone, but the
  // stream may go on for a while.
  void close();

 private:
  void give(ViewQueue::Piece piece);
  // Returns false when no piece waits.
  bool put_in_next();

  const std::shared_ptr<ViewBuilder> builder_;
  const Help help_;
  ViewQueue queue_;
  std::mutex giving_;
  bool closed_ = false;
  std::mutex putting_in_;  // one piece after the other
};

}  // namespace trc::server::http
