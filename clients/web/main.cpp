// lockstep-web: the command line.
#include <csignal>
#include <filesystem>
#include <iostream>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "clients/web/site.hpp"
#include "clients/web/token_file.hpp"
#include "services/arguments/argument_parser.hpp"
#include "services/files/directories.hpp"
#include "services/files/text_file.hpp"
#include "services/network/host_name.hpp"
#include "services/runtime/stop_signal.hpp"

namespace {

using namespace lockstep;
using namespace std::chrono_literals;

struct Options {
    std::string machine_file;
    std::optional<std::string> address;
    std::optional<std::uint16_t> port;
    std::optional<std::string> certificate;
    std::optional<std::string> key;
    std::vector<std::string> host_names;
    std::string token_file;
    std::string page_file;
    std::string reports;
};

/// The settings of the machine's file, overridden by those of the command line.
WebConfig merged(const Options& options, const MachineSetup& machine) {
    WebConfig web = machine.web.value_or(WebConfig{});
    web.address = options.address.value_or(web.address);
    web.port = options.port.value_or(web.port);
    web.certificate_file = options.certificate.value_or(web.certificate_file);
    web.key_file = options.key.value_or(web.key_file);
    web.host_names.insert(web.host_names.end(), options.host_names.begin(), options.host_names.end());
    return web;
}

std::expected<web::TlsFiles, Failure> read_tls(const WebConfig& web) {
    web::TlsFiles tls;
    for (const auto& [file, text] : {std::pair{&web.certificate_file, &tls.certificate}, {&web.key_file, &tls.key}}) {
        if (file->empty()) { continue; }
        auto read = read_text_file(*file);
        if (!read) { return std::unexpected(bad_file(*file, {read.error()})); }
        *text = *std::move(read);
    }
    return tls;
}

std::string address_text(const WebConfig& web, const Listener& listener) {
    const bool is_six = web.address.contains(':');
    return fmt::format("{}://{}:{}/", web.certificate_file.empty() ? "http" : "https",
                       is_six ? "[" + web.address + "]" : web.address, listener.port);
}

web::AccessRules rules_of(const WebConfig& web, const Listener& listener, const web::Tokens& tokens) {
    web::AccessRules rules{.tokens = tokens,
                           .hosts = {"localhost", "127.0.0.1", "::1", web.address},
                           .port = listener.port,
                           .is_tls = !web.certificate_file.empty()};
    if (!listener.is_loopback) { rules.hosts.push_back(host_name()); }
    rules.hosts.insert(rules.hosts.end(), web.host_names.begin(), web.host_names.end());
    return rules;
}

/// The addresses contain tokens, which must not get into a log: with --page-file they go to that file instead.
std::expected<void, std::string> publish(const Options& options, const std::string& address, const web::Tokens& tokens,
                                         const std::string& heading) {
    const std::string links = fmt::format("{}#token={}\n{}#token={}\n", address, tokens.operate, address, tokens.view);
    if (options.page_file.empty()) {
        std::cout << heading << '\n' << links << std::flush;
        return {};
    }
    std::cout << heading << "; this address with them is in " << options.page_file << '\n'
              << address << '\n'
              << std::flush;
    std::error_code none;
    std::filesystem::remove(options.page_file, none);
    return create_text_file(options.page_file, links, 0600);
}

/// Serves until a signal asks to end.
ExitCode serve(const Options& options, const WebConfig& web, const ChosenMachine& machine, const web::TlsFiles& tls,
               const Listener& listener, Output& output) {
    const std::filesystem::path root = record_directory(machine.config.name).parent_path();
    const std::filesystem::path file =
        options.token_file.empty() ? root / "web" / "tokens" : std::filesystem::path(options.token_file);
    const auto tokens = web::tokens_of_file(file);
    if (!tokens) { return output.fail(failed(tokens.error())); }
    auto session = Session::join(machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    const StopSignal stop;
    const auto site =
        web::Site::open(*std::move(session),
                        {.listener = listener,
                         .tls = tls,
                         .rules = rules_of(web, listener, *tokens),
                         .reports = options.reports.empty() ? root / "reports" : std::filesystem::path(options.reports),
                         .version = LOCKSTEP_VERSION,
                         .writer = "the page at " + address_text(web, listener)});
    if (!site) { return output.fail(failed(site.error())); }
    const std::string heading =
        fmt::format("machine '{}': page addresses to operate and to view it; the tokens are also in {}",
                    machine.config.name, file.string());
    const auto published = publish(options, address_text(web, listener), *tokens, heading);
    if (!published) { return output.fail(failed(published.error() + "; name another file: --page-file FILE")); }
    while (!stop.requested()) { std::this_thread::sleep_for(50ms); }
    std::error_code none;
    if (!options.page_file.empty()) { std::filesystem::remove(options.page_file, none); }
    return kExitDone;
}

int run(const Options& options) {
    Output output(false);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const WebConfig web = merged(options, machine->config);
    const auto tls = read_tls(web);
    if (!tls) { return output.fail(tls.error()); }
    const auto listener = listen_at(web.address, static_cast<std::uint16_t>(web.port));
    if (!listener) { return output.fail(failed(listener.error())); }
    if (!listener->is_loopback && !tls->is_used()) {
        return output.fail(bad_input("--address " + web.address +
                                     ": other hosts are served with TLS only; add --certificate FILE and "
                                     "--key FILE, or listen at 127.0.0.1 and use an SSH tunnel"));
    }
    return serve(options, web, *machine, *tls, *listener, output);
}

}  // namespace

int main(int argc, char** argv) {
    ArgumentParser parser(
        "Serves a page for a machine, and the page's HTTP interface, until SIGTERM or SIGINT. No motion of the machine "
        "depends on this process.");
    Options options;
    parser.add_option("--machine", options.machine_file, kMachineHelp);
    parser.add_option(
        "--address", options.address,
        "the address to listen at; an address that other hosts can reach needs a certificate; default: 127.0.0.1");
    parser.add_option("--port", options.port, "the TCP port; 0: a free one; default: 2302");
    const Argument certificate = parser.add_option("--certificate", options.certificate, "serve HTTPS: the PEM file");
    const Argument key = parser.add_option("--key", options.key, "the certificate's key, a PEM file");
    certificate.needs(key);
    key.needs(certificate);
    parser.add_option("--host-name", options.host_names,
                      "another host name under which the page may be opened, in addition to localhost and the address");
    parser.add_option(
        "--token-file", options.token_file,
        "the file of the tokens, which is created if it is missing; default: beside the machine's record");
    parser.add_option(
        "--page-file", options.page_file,
        "write the page's addresses, with their tokens, into this file that only its user can read, and not "
        "to standard output, which may be a log; it is removed at the end");
    parser.add_option("--reports", options.reports,
                      "the directory of report pages to show; default: beside the machine's record");
    parser.footer(
        "Address, port, certificate and names of hosts are those of web { } in the machine's file, unless they are "
        "given here.\nExamples:\n  lockstep-web\n  lockstep-web --machine mill.textproto --port 8080\n"
        "  lockstep-web --address 0.0.0.0 --certificate mill.crt --key mill.key --host-name mill.example\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration, 3 machine not reachable");
    parser.action([&] { return run(options); });
    return parser.run(argc, argv);
}
