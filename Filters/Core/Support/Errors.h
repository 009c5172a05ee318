#ifndef dmgErrors_h
#define dmgErrors_h

#include <stdexcept>
#include <string>

namespace dmg
{

/// The caller can repair the data. The message names the element and the remedy:
/// "face 812 has no area; leave it out".
class InvalidInput : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The data are legal and the method failed on them.
class SolverFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// The method failed where it never should: to the message, it adds what a user can do.
class UnexpectedFailure : public SolverFailure
{
public:
  explicit UnexpectedFailure(const std::string& message)
    : SolverFailure(
        message + "; no input is known that causes this, so please report it with the data and the properties")
  {
  }
};

/// The user asked to stop. Not an error.
class Cancelled : public std::exception
{
public:
  const char* what() const noexcept override { return "cancelled"; }
};

}

#endif
