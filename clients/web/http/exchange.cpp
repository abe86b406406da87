#include "clients/web/http/exchange.hpp"

#include <sys/socket.h>

#include <cstdlib>

#include "clients/web/http/head_reader.hpp"
#include "clients/web/http/server.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kStreamBlock_bytes = 16 * 1024;
constexpr int kStreamBuffer_bytes = 64 * 1024;  // in the kernel, for a viewer that reads slowly

ssize_t read_from(void* exchange, std::uint64_t, char* into, std::size_t size) {
    return static_cast<Exchange*>(exchange)->read_stream(into, size);
}

void free_text(void* text) { delete static_cast<SharedText*>(text); }

MHD_Response* response_of(const SharedText& text) {
    // libmicrohttpd reads the bytes and does not write to them.
    return MHD_create_response_from_buffer_with_free_callback_cls(text->size(), const_cast<char*>(text->data()),
                                                                  free_text, new SharedText(text));
}

std::size_t size_of(const Response& response) {
    if (const auto* text = std::get_if<SharedText>(&response.body)) { return (*text)->size(); }
    if (const auto* text = std::get_if<std::string_view>(&response.body)) { return text->size(); }
    const auto* text = std::get_if<std::string>(&response.body);
    return text == nullptr ? 0 : text->size();
}

void keep_little(MHD_Connection* connection) {
    const auto* info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
    if (info == nullptr) { return; }
    (void)setsockopt(info->connect_fd, SOL_SOCKET, SO_SNDBUF, &kStreamBuffer_bytes, sizeof kStreamBuffer_bytes);
}

}  // namespace

void Exchange::wait(Waits what, std::size_t bytes) { limits_.wait(connection_, what, bytes, monotonic_now()); }

MHD_Result Exchange::begin(const char* path, const char* method, const char* version) {
    has_begun_ = true;
    read_head(connection_, path, method, version, request_);
    const Intake intake = handler_.intake(request_);
    body_limit_bytes_ = intake.body_limit_bytes;
    wait(Waits::ForBody, body_limit_bytes_);
    if (intake.is_signed_in) { limits_.sign_in(connection_); }
    if (intake.is_refused) { return give_to_handler(); }
    const std::string* length = request_.header("content-length");
    const bool is_long = length != nullptr && std::strtoull(length->c_str(), nullptr, 10) > body_limit_bytes_;
    if (!is_long || request_.header("expect") == nullptr) { return MHD_YES; }
    request_.is_too_long = true;  // the client waits for a response before it sends the body
    return give_to_handler();
}

MHD_Result Exchange::take_body(const char* bytes, std::size_t* size) {
    received_ += *size;
    if (received_ <= body_limit_bytes_) {
        request_.body.append(bytes, *size);
    } else if (!request_.is_too_long) {
        request_.is_too_long = true;
        request_.body = {};
    }
    *size = 0;
    // A client reads its answer only after it has sent everything. So the rest is read and discarded, up to a limit.
    return received_ <= Server::kMostDiscarded ? MHD_YES : MHD_NO;
}

MHD_Result Exchange::proceed() {
    if (!is_handled_) { return give_to_handler(); }
    const std::lock_guard lock(mutex_);
    return response_ ? queue(*response_) : MHD_NO;
}

MHD_Result Exchange::give_to_handler() {
    is_handled_ = true;
    wait(Waits::ForServer, 0);
    handler_.handle(std::move(request_), [weak = weak_from_this()](Response&& response) {
        if (const auto exchange = weak.lock()) { exchange->answer(std::move(response)); }
    });
    const std::lock_guard lock(mutex_);
    if (response_) { return queue(*response_); }
    if (is_over_) { return MHD_NO; }
    MHD_suspend_connection(connection_);
    is_suspended_ = true;
    return MHD_YES;
}

void Exchange::answer(Response&& response) {
    const std::lock_guard lock(mutex_);
    if (is_over_ || response_) { return; }
    response_ = std::move(response);
    resume_locked();
}

void Exchange::resume_locked() {
    if (!is_suspended_) { return; }
    is_suspended_ = false;
    MHD_resume_connection(connection_);
}

MHD_Response* Exchange::made(const Response& response) {
    if (const auto* text = std::get_if<std::string_view>(&response.body)) {
        return MHD_create_response_from_buffer(text->size(), const_cast<char*>(text->data()), MHD_RESPMEM_PERSISTENT);
    }
    if (const auto* stream = std::get_if<std::shared_ptr<ByteStream>>(&response.body)) {
        stream_ = *stream;
        keep_little(connection_);
        return MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, kStreamBlock_bytes, read_from, this, nullptr);
    }
    if (const auto* text = std::get_if<SharedText>(&response.body)) { return response_of(*text); }
    return response_of(std::make_shared<const std::string>(std::get<std::string>(response.body)));
}

MHD_Result Exchange::queue(const Response& response) {
    MHD_Response* made_response = made(response);
    if (made_response == nullptr) { return MHD_NO; }
    for (const auto& [name, value] : response.headers) {
        (void)MHD_add_response_header(made_response, name.c_str(), value.c_str());
    }
    if (!stream_) { wait(Waits::ForReader, size_of(response)); }
    const MHD_Result queued = MHD_queue_response(connection_, static_cast<unsigned>(response.status), made_response);
    MHD_destroy_response(made_response);
    return queued;
}

ssize_t Exchange::read_stream(char* into, std::size_t size) {
    const std::lock_guard lock(mutex_);
    if (is_over_) { return MHD_CONTENT_READER_END_OF_STREAM; }
    const auto bytes = stream_->read({into, size});
    if (!bytes) { return MHD_CONTENT_READER_END_OF_STREAM; }
    if (*bytes == 0) {
        MHD_suspend_connection(connection_);
        is_suspended_ = true;
    }
    return static_cast<ssize_t>(*bytes);
}

void Exchange::wake_stream() {
    const std::lock_guard lock(mutex_);
    if (!stream_ || is_over_) { return; }
    resume_locked();
    if (!stream_->is_behind()) { return; }
    const auto* info = MHD_get_connection_info(connection_, MHD_CONNECTION_INFO_CONNECTION_FD);
    if (info != nullptr) { (void)shutdown(info->connect_fd, SHUT_RDWR); }
}

void Exchange::end() {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    if (stream_) { stream_->end(); }
    wait(Waits::ForHead, 0);
}

void Exchange::release() {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    resume_locked();
}

}  // namespace lockstep::web
