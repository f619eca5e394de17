// Values that are made once for all who ask.
#include "framework/common/made_once.h"

#include <atomic>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace pintle::made_once_test {
namespace {

using Numbers = MadeOnce<int>;
std::size_t hundred(const int&) { return 100; }

TEST(MadeOnce, WhoAsksMeanwhileGetsTheSame) {
  Numbers numbers(1000, hundred);
  std::atomic<int> made = 0, asking = 0;
  std::vector<std::shared_ptr<const int>> got(4);
  std::vector<std::thread> threads;
  for (auto& one : got)
    threads.emplace_back([&] {
      ++asking;
      one = numbers.get("a", [&] {
        while (asking < 4) std::this_thread::yield();
        return ++made;
      });
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(made, 1);
  for (const auto& one : got) EXPECT_EQ(one, got.front());
}

TEST(MadeOnce, WhatIsOfNoUseAnyMoreGoesFirst) {
  Numbers numbers(310, hundred);  // three, with keys of one letter
  int made = 0;
  const auto ask = [&](const char* key) { return numbers.get(key, [&] { return ++made; }); };
  const auto a = ask("a");
  ask("b"), ask("c"), ask("a");
  EXPECT_EQ(made, 3);
  ask("d");  // b goes
  EXPECT_EQ(numbers.bytes(), 303u);
  ask("a"), ask("c"), ask("d");
  EXPECT_EQ(made, 4);
  ask("b");
  EXPECT_EQ(made, 5);
  EXPECT_EQ(*ask("d"), 4);
  EXPECT_EQ(*a, 1);
}

TEST(MadeOnce, WhatIsTooLargeIsNotKept) {
  Numbers numbers(50, hundred);
  int made = 0;
  for (int k = 1; k <= 2; ++k) EXPECT_EQ(*numbers.get("a", [&] { return ++made; }), k);
  EXPECT_EQ(numbers.bytes(), 0u);
}

TEST(MadeOnce, AFailureIsForEachToMeet) {
  Numbers numbers(1000, hundred);
  std::atomic<int> tried = 0, asking = 0, failed = 0;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&] {
      ++asking;
      try {
        numbers.get("a", [&]() -> int {
          while (asking < 4) std::this_thread::yield();
          ++tried;
          throw std::runtime_error("no");
        });
      } catch (const std::runtime_error&) {
        ++failed;
      }
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(tried, 4);
  EXPECT_EQ(failed, 4);
  EXPECT_EQ(*numbers.get("a", [] { return 7; }), 7);
}

}  // namespace
}  // namespace pintle::made_once_test
