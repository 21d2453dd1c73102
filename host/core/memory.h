#pragma once
// Memory of the host: how much is left, and what it is wanted for where it runs out.
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace facet {

/// What a thread is doing while this lives: said where memory or time runs out. Activities nest;
/// the innermost counts.
class Activity {
 public:
  /// what: "reading the mesh bunny.obj".
  explicit Activity(std::string what) : Activity(std::move(what), 0, "") {}
  /// Of things that take so many bytes each: the message says how many of them fit. unit: their
  /// name, in the plural.
  Activity(std::string what, std::uint64_t bytes_each, std::string unit);
  ~Activity();
  Activity(const Activity&) = delete;
  Activity& operator=(const Activity&) = delete;

  /// The innermost of this thread, or none.
  [[nodiscard]] static const Activity* innermost() noexcept;
  /// This thread, a new one, works for another that is doing this, or nothing, until both end.
  static void adopt(const Activity* activity) noexcept;
  /// Gives, whenever it is called and from any thread, what this thread is then doing; empty where
  /// that is nothing. Not to be called when this thread has ended.
  [[nodiscard]] static std::function<std::string()> watch();

  [[nodiscard]] const std::string& what() const noexcept { return what_; }
  [[nodiscard]] std::uint64_t bytes_each() const noexcept { return bytes_each_; }
  [[nodiscard]] const std::string& unit() const noexcept { return unit_; }

 private:
  std::string what_;
  std::uint64_t bytes_each_;
  std::string unit_;
  const Activity* outer_;
};

/// "out of memory while reading the mesh bunny.obj: 1.2 GB more would be needed, 300 MB are left":
/// of an allocation that this thread has been refused.
[[nodiscard]] std::string describe_lack(std::uint64_t bytes);

/// Bytes of data that this process may have; nothing where there is no limit.
[[nodiscard]] std::optional<std::uint64_t> memory_limit();

/// Bytes that this process can still take: what the machine, its container and the process's own
/// limits leave. Nothing where the system does not say.
[[nodiscard]] std::optional<std::uint64_t> available_memory();

}  // namespace facet
