// An optional value apart from its owner behaves as std::optional does.
#include "framework/common/heap_optional.h"

#include <string>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

namespace pintle::heap_optional_test {
namespace {

using Words = HeapOptional<std::string>;

TEST(HeapOptional, TakesThePlaceOfAPointer) {
  EXPECT_EQ(sizeof(Words), sizeof(void*));
  EXPECT_TRUE(std::is_nothrow_move_constructible_v<Words>);  // so that vectors of owners move them as they grow
}

TEST(HeapOptional, CopiesItsValue) {
  Words one = std::string("pin");
  Words other = one;
  *other += "ned";
  EXPECT_EQ(*one, "pin");
  EXPECT_EQ(*other, "pinned");
  one = other;
  EXPECT_EQ(*one, "pinned");
  EXPECT_NE(&*one, &*other);
  const Words& same = one;
  one = same;
  EXPECT_EQ(one->size(), 6u);
}

TEST(HeapOptional, IsEmptyUntilItHasAValue) {
  Words words;
  EXPECT_FALSE(words);
  EXPECT_FALSE(Words(words).has_value());
  words.emplace("guide");
  EXPECT_TRUE(words.has_value());
  words = std::nullopt;
  EXPECT_FALSE(words);
  words = std::string("slot");
  const Words taken = std::move(words);
  EXPECT_EQ(*taken, "slot");
  Words last = taken;
  last.reset();
  EXPECT_FALSE(last);
}

}  // namespace
}  // namespace pintle::heap_optional_test
