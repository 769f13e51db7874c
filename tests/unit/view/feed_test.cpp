#include "tessera/view/feed.h"

#include <gtest/gtest.h>

#include <thread>

namespace tessera::view {
namespace {

Content picture(int width) {
  return {std::make_shared<const Flat>(Flat{Raster{width, 1, 3, 8, {}}, {0.0 + width, 1}}), {}};
}

TEST(Feed, the_newest_content_is_fetched_once) {
  Feed feed;
  EXPECT_TRUE(feed.is_awaited());
  feed.show(picture(1));
  feed.show(picture(2));
  EXPECT_FALSE(feed.is_awaited());
  const News news = feed.take();
  ASSERT_TRUE(news.content);
  EXPECT_EQ(news.content->flat->size.width, 2);
  EXPECT_FALSE(feed.take().content);
  EXPECT_TRUE(feed.is_awaited());
}

TEST(Feed, what_was_told_stays) {
  Feed feed;
  feed.stage("lloyd");
  feed.progress(0.25);
  for (int time = 0; time < 2; ++time) {
    const News news = feed.take();
    EXPECT_EQ(news.stage, "lloyd");
    EXPECT_EQ(news.fraction, 0.25);
    EXPECT_EQ(news.state, News::State::kWorking);
  }
  feed.end(false);
  EXPECT_EQ(feed.take().state, News::State::kFailed);
}

// What is shown before the end is there with the end or before it, never after.
TEST(Feed, the_last_content_comes_no_later_than_the_end) {
  for (int time = 0; time < 50; ++time) {
    Feed feed;
    std::thread worker([&feed] {
      for (int width = 1; width <= 20; ++width) feed.show(picture(width));
      feed.end(true);
    });
    double seen = 0;
    for (News::State state = News::State::kWorking; state != News::State::kDone;) {
      const News news = feed.take();
      if (news.content) {
        EXPECT_GT(news.content->flat->size.width, seen);
        seen = news.content->flat->size.width;
      }
      state = news.state;
    }
    EXPECT_EQ(seen, 20);
    worker.join();
  }
}

}  // namespace
}  // namespace tessera::view
