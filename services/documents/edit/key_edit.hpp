// Changes single keys in the text of a machine's file, and leaves everything else in it as it is, comments too.
#pragma once

#include <string>
#include <string_view>

namespace lockstep {

/// `path`: "timing", "timing.slot_us", "axis[1].homing.pulloff_mm".
bool has_key(std::string_view text, const std::string& path);

/// Replaces the value, or adds the key. A block that the text does not have is added to the block around it, which must
/// exist. False: a comment stands between the key and its value, and nothing was changed.
bool set_key(std::string& text, const std::string& path, const std::string& value);

}  // namespace lockstep
