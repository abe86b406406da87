// Owns one entity of the DDS C API. The destructor deletes the entity.
#pragma once

#include <dds/dds.h>

#include <utility>

namespace lockstep {

class Entity {
public:
    Entity() = default;
    /// A negative handle means that creation failed; see why_not().
    explicit Entity(dds_entity_t handle) : handle_(handle) {}
    Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
    Entity& operator=(Entity&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Entity() {
        if (good()) { dds_delete(handle_); }
    }

    bool good() const { return handle_ > 0; }
    dds_entity_t handle() const { return handle_; }
    const char* why_not() const { return dds_strretcode(handle_); }

private:
    dds_entity_t handle_ = 0;
};

}  // namespace lockstep
