// A cache by key. A value that somebody holds is always found. Of those that nobody holds, the latest used
// are kept up to a limit of their total size, and older ones are forgotten.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace clothsim {

template <class Key, class Value>
class Recent {
 public:
  using Pointer = std::shared_ptr<const Value>;

  // `mostKept`: the limit, in the unit of the sizes that add() takes.
  explicit Recent(std::size_t mostKept) : mostKept_(mostKept) {}

  // Null when the key was never added, or its value was forgotten.
  [[nodiscard]] Pointer find(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto known =
        std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.key == key; });
    if (known == known_.end()) return nullptr;
    Pointer value = known->value.lock();
    if (!value) return nullptr;
    std::rotate(known_.begin(), known, known + 1);
    known_.front().kept = value;
    forget();
    return value;
  }

  // Replaces what the key stood for before.
  void add(Key key, Pointer value, std::size_t size) {
    const std::lock_guard lock(mutex_);
    std::erase_if(known_, [&](const Known& known) { return known.key == key; });
    known_.insert(known_.begin(), Known{std::move(key), value, size, value});
    forget();
  }

 private:
  struct Known {
    Key key;
    std::weak_ptr<const Value> value;
    std::size_t size;
    Pointer kept;
  };

  void forget() {
    std::size_t size = 0;
    for (Known& known : known_)
      if (known.kept && (size += known.size) > mostKept_) known.kept.reset();
    std::erase_if(known_, [](const Known& known) { return known.value.expired(); });
  }

  std::size_t mostKept_;
  std::mutex mutex_;
  std::vector<Known> known_;  // the latest first
};

}  // namespace clothsim
