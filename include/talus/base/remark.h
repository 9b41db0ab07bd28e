// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_remark_h
#define talus_base_remark_h

#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Meaning of a remark for the results.
  enum class Severity
  {
    information, ///< an intended consequence of the parameters
    look,        ///< possibly a mistake in the input, or a loss of accuracy
    wrong        ///< the results must not be used
  };



  /// A sentence to the user on the input or on the results.
  struct Remark
  {
    Remark(std::string    what,
           const Severity severity_of_what = Severity::look,
           std::string    part             = "")
      : sentence(std::move(what))
      , severity(severity_of_what)
      , subject(std::move(part))
    {}

    Remark(const char *what)
      : Remark(std::string(what))
    {}

    /// Return subject and sentence.
    std::string
    text() const;

    std::string sentence;
    Severity    severity;
    std::string subject; ///< part of the input, as "body 'a'"; may be empty
  };



  /// Return @p remarks without empty sentences, and with equal sentences joined
  /// to one on all subjects.
  std::vector<Remark>
  joined(const std::vector<Remark> &remarks);
} // namespace talus

#endif
