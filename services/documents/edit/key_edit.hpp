// Changes single keys in the text of a machine's file, and leaves everything else unchanged, including comments.
#pragma once

#include <string>
#include <string_view>

namespace lockstep {

/// `path` is, for example, "timing", "timing.slot_us" or "axis[1].homing.pulloff_mm".
bool has_key(std::string_view text, const std::string& path);

/// Replaces the value, or adds the key. If the text lacks the key's block, it adds the block to the one around it,
/// which must exist. Returns false and changes nothing if a comment stands between the key and its value.
bool set_key(std::string& text, const std::string& path, const std::string& value);

}  // namespace lockstep
