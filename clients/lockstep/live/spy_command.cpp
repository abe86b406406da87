#include "clients/lockstep/live/spy_command.hpp"

#include <unistd.h>
#include <xcb/xcb.h>

#include <cstdlib>
#include <memory>
#include <sstream>

#include "clients/supervisor/program_folder.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

std::optional<fs::path> find_program(const std::string& name) {
    std::istringstream folders(variable("PATH"));
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path path = fs::path(folder) / name;
        std::error_code error;
        if (access(path.c_str(), X_OK) == 0) { return fs::canonical(path, error); }
    }
    return std::nullopt;
}

/// Whether this Java can open windows. A headless Java lacks the library.
bool has_windows(const fs::path& java) {
    return fs::exists(java.parent_path().parent_path() / "lib" / "libawt_xawt.so");
}

bool answers(const std::string& display) {
    if (display.empty()) { return false; }
    const std::unique_ptr<xcb_connection_t, decltype(&xcb_disconnect)> x(xcb_connect(display.c_str(), nullptr),
                                                                         &xcb_disconnect);
    return xcb_connection_has_error(x.get()) == 0;
}

std::string class_path(const std::vector<fs::path>& jars) {
    std::string text;
    for (const fs::path& jar : jars) { text += (text.empty() ? "" : ":") + jar.string(); }
    return text;
}

}  // namespace

SpyHost look_at_host() {
    const std::string display = variable("DISPLAY");
    return {.display = display,
            .display_answers = answers(display),
            .java = find_program("java"),
            .jars = {LOCKSTEP_LCM_JAR, LOCKSTEP_JCHART2D_JAR,
                     program_folder().parent_path() / "share" / "lockstep" / "lockstep-lcm.jar"}};
}

std::expected<std::vector<std::string>, Failure> spy_command(const SpyHost& host, const std::string& lcm_url) {
    const auto lacks = [](const std::string& what) { return std::unexpected(failed("lcm-spy " + what)); };
    if (host.display.empty()) {
        return lacks(
            "needs windows, but DISPLAY names no display: run it on a desktop, or over ssh -X; "
            "without one: lockstep watch");
    }
    if (!host.display_answers) {
        return lacks("needs windows, but display " + host.display +
                     " does not answer or refuses the connection: set DISPLAY to that of your desktop (and XAUTHORITY, "
                     "as another "
                     "user), or use ssh -X; without one: lockstep watch");
    }
    if (!host.java) { return lacks("needs Java, but PATH has none: apt-get install default-jre"); }
    if (!has_windows(*host.java)) {
        return lacks("needs a Java with windows, but " + host.java->string() +
                     " is headless: apt-get install default-jre");
    }
    for (const fs::path& jar : host.jars) {
        if (fs::exists(jar)) { continue; }
        return lacks("needs " + jar.string() +
                     ", which is not there: apt-get install liblcm-java libjchart2d-java; "
                     "lockstep-lcm.jar is built with the lockstep command");
    }
    return std::vector<std::string>{
        host.java->string(),   "-Djava.net.preferIPv4Stack=true", "-cp", class_path(host.jars), "lcm.spy.Spy",
        "--lcm-url=" + lcm_url};
}

}  // namespace lockstep
