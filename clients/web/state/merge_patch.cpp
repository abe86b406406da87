#include "clients/web/state/merge_patch.hpp"

namespace lockstep::web {

using nlohmann::json;

json merge_patch(const json& from, const json& to) {
    json patch = json::object();
    for (const auto& [name, value] : to.items()) {
        const auto before = from.find(name);
        const bool is_absent = before == from.end();
        if ((is_absent && value.is_null()) || (!is_absent && *before == value)) { continue; }
        const bool is_inside = !is_absent && before->is_object() && value.is_object();
        json change = is_inside ? merge_patch(*before, value) : value;
        if (!is_inside || !change.empty()) { patch[name] = std::move(change); }
    }
    for (const auto& [name, value] : from.items()) {
        if (!to.contains(name)) { patch[name] = nullptr; }
    }
    return patch;
}

}  // namespace lockstep::web
