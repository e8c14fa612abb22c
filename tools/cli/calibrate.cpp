#include <nearfield/diagnostics.hpp>

#include <tools/cli/calibrate.hpp>
#include <tools/common/library_error.hpp>
#include <tools/io/cost_model.hpp>
#include <tools/io/report_target.hpp>
#include <unistd.h>

#include <functional>
#include <iostream>

namespace nearfield::tools {

CLI::App* add_calibrate_command(CLI::App& program, CalibrateArguments& arguments) {
    CLI::App* command = program.add_subcommand(
        "calibrate",
        "Measure what each technique costs on this machine (some seconds), for --costs of the "
        "other commands: what --technique automatic goes by");
    command
        ->add_option("file", arguments.file,
                     "Where the measured times go, JSON; - for the standard output; required")
        ->required()
        ->type_name("FILE|-");
    return command;
}

void run_calibrate(const CalibrateArguments& arguments) {
    ReportTarget target(arguments.file);
    Context context = take(Context::create_headless());
    std::function<void(double)> progress;
    if (isatty(STDERR_FILENO) == 1) {
        progress = [](double done) {
            std::cerr << "\rmeasured " << static_cast<int>(100.0 * done) << " %" << std::flush;
        };
    }
    const CostModel costs = take(measure_costs(context, progress));
    if (progress) {
        std::cerr << '\n';
    }
    write_cost_model(*target.json(), costs, context.device_name());
    target.commit();
}

}  // namespace nearfield::tools
