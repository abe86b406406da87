// Functions to assemble pages.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace lockstep::analysis {

/// Escapes JSON so that it contains no tag and is safe within a page.
std::string within_page(const std::string& json);

/// Replaces each @NAME@ of the template by its text, in one pass: inserted texts are not searched again.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& texts);

}  // namespace lockstep::analysis
