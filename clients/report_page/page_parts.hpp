// Functions to assemble pages.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace lockstep::analysis {

/// JSON that is safe within a page: no tag begins or ends in it.
std::string within_page(std::string json);

/// The template with each @NAME@ replaced by its text, in one pass: inserted texts are not searched again.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& texts);

}  // namespace lockstep::analysis
