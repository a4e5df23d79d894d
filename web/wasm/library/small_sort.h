// std::sort and std::stable_sort in a fifth of their code in libc++, which is written out for every comparison: more
// than a tenth of a page's module. As fast for elements in no order: pivots are medians of three, and few elements are
// inserted.
#pragma once

#include <__iterator/wrap_iter.h>
#include <__config>
#include <cstddef>

_LIBCPP_BEGIN_NAMESPACE_STD

/// What std::sort calls for elements that lie one after the other. Libc++ has it for any iterators; this one is more
/// special, and has to be known before. A library that calls another function has its own sort, no other results.
template <class Compare, class T>
void __sort(T* first, T* last, Compare less);
/// The same of std::stable_sort, of elements of vectors, with a buffer that this one does not need.
template <class Compare, class T>
void __stable_sort(__wrap_iter<T*> first, __wrap_iter<T*> last, Compare less, std::ptrdiff_t size, T* buffer,
                   std::ptrdiff_t buffer_size);

_LIBCPP_END_NAMESPACE_STD

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace dymsum::small {

template <class Compare, class T>
void insert(T* first, T* last, Compare less) {
  for (T* i = first + 1; i < last; ++i) {
    T held = std::move(*i);
    T* to = i;
    for (; to != first && less(held, to[-1]); --to) *to = std::move(to[-1]);
    *to = std::move(held);
  }
}

/// Puts the pivot where it belongs: none before it is greater, none behind it less. Requires 3 elements or more.
template <class Compare, class T>
T* split(T* first, T* last, std::uint32_t random, Compare less) {
  using std::swap;
  const auto size = static_cast<std::uint64_t>(last - first);
  swap(first[1], first[random * size >> 32]);
  swap(first[2], last[-1]);
  insert<Compare>(first, first + 3, less);
  T *const pivot = first + 1, *i = pivot, *j = last;
  for (;;) {  // the first step stops i at the third element; what is swapped stops the others
    do ++i;
    while (less(*i, *pivot));
    do --j;
    while (less(*pivot, *j));
    if (i >= j) break;
    swap(*i, *j);
  }
  swap(*pivot, *j);
  return j;
}

/// Equal elements keep their order.
template <class Compare, class T>
void sort_stably(T* first, T* last, Compare less) {
  if (last - first <= 16) return insert<Compare>(first, last, less);
  T* const midpoint = first + (last - first) / 2;
  sort_stably<Compare>(first, midpoint, less);
  sort_stably<Compare>(midpoint, last, less);
  if (!less(*midpoint, midpoint[-1])) return;
  std::vector<T> front(std::make_move_iterator(first), std::make_move_iterator(midpoint));
  T *i = front.data(), *const end = i + front.size(), *j = midpoint;
  for (T* to = first; i != end; ++to) *to = j != last && less(*j, *i) ? std::move(*j++) : std::move(*i++);
}

}  // namespace dymsum::small

_LIBCPP_BEGIN_NAMESPACE_STD

// One of three elements is drawn: no order of the elements is slow but one made against these numbers.
template <class Compare, class T>
void __sort(T* first, T* last, Compare less) {
  constexpr std::ptrdiff_t kFew = 16;
  T* ascending = first;  // as far as they do
  while (last - ascending > 1 && !less(ascending[1], *ascending)) ++ascending;
  if (last - ascending <= 1) return;
  std::uint32_t random = 1;
  while (last - first > kFew) {
    random = random * 1664525 + 1013904223;
    T* const midpoint = dymsum::small::split<Compare>(first, last, random, less);
    if (midpoint - first < last - midpoint) {
      std::__sort<Compare>(first, midpoint, less);
      first = midpoint + 1;
    } else {
      std::__sort<Compare>(midpoint + 1, last, less);
      last = midpoint;
    }
  }
  dymsum::small::insert<Compare>(first, last, less);
}

template <class Compare, class T>
void __stable_sort(__wrap_iter<T*> first, __wrap_iter<T*> last, Compare less, std::ptrdiff_t, T*, std::ptrdiff_t) {
  if (first != last) dymsum::small::sort_stably<Compare>(&*first, &*first + (last - first), less);
}

_LIBCPP_END_NAMESPACE_STD
