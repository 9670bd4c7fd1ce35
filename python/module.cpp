// The Python module trivela._trivela: flat arrays in and out. What people call is python/trivela/*.py.
#include <pybind11/pybind11.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>

#include "config/text/error.hpp"
#include "config/text/installation.hpp"
#include "evaluator/counting/log_kicks.hpp"
#include "log/schema/refused_log.hpp"
#include "python/arrays.hpp"

namespace trivela::python {
namespace {

/// Sentences on a file that is not there have the system's reason, those on a log begin so.
bool says_missing(const std::string& sentence) {
  return sentence.starts_with("there is no ") || sentence.find(std::strerror(ENOENT)) != std::string::npos;
}

void set_error(const std::exception& error, PyObject* type) {
  PyErr_SetString(says_missing(error.what()) ? PyExc_FileNotFoundError : type, error.what());
}

/// Bad arguments and files are ValueError, missing files FileNotFoundError, anything else RuntimeError.
void translate(std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): pybind11's type
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const config::Error& error) {
    set_error(error, PyExc_ValueError);
  } catch (const evaluator::BadOption& error) {
    set_error(error, PyExc_ValueError);
  } catch (const log::RefusedLog& error) {
    set_error(error, PyExc_ValueError);
  } catch (const std::invalid_argument& error) {
    set_error(error, PyExc_ValueError);
  } catch (const std::runtime_error& error) {
    set_error(error, PyExc_RuntimeError);
  }
}

}  // namespace
}  // namespace trivela::python

PYBIND11_MODULE(_trivela, module) {
  using namespace trivela;
  pybind11::register_exception_translator(python::translate);
  module.attr("version") = config::software_version();
  module.def(
      "configuration_folder", [] { return config::folder().string(); },
      "The folder of the shipped configuration: default.toml, robots, scenarios, arms.");
  python::add_robots(module);
  python::add_kicks(module);
  python::add_judgement(module);
  python::add_policies(module);
  python::add_simulate(module);
  python::add_logs(module);
  python::add_comparisons(module);
  python::add_statistics(module);
  python::add_calibration(module);
}
