#pragma once
// The files that the arguments of `facet merge` name.
#include <string>
#include <vector>

namespace facet {

/// Files stay; of a folder its files *.exr, but for hidden ones; of a pattern of glob(7), where
/// there is no such file, what it stands for, sorted. `outputs` are left out where a folder or a
/// pattern holds them: an earlier merge's result is no part. Throws InputError, which names it, for
/// a folder or a pattern that holds none.
[[nodiscard]] std::vector<std::string> find_parts(const std::vector<std::string>& arguments,
                                                  const std::vector<std::string>& outputs);

}  // namespace facet
