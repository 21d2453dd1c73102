#pragma once

namespace facet {

/// Whether this build is watched by AddressSanitizer, with its own reports of crashes and of leaks.
#ifdef __SANITIZE_ADDRESS__
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

}  // namespace facet
