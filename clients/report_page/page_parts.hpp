// What pages are put together with.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace lockstep::analysis {

/// JSON that may stand within a page: no tag begins or ends in it.
std::string within_page(std::string json);

/// The template with each @NAME@ replaced by its text, once over: what is put in is not looked at again.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& texts);

}  // namespace lockstep::analysis
