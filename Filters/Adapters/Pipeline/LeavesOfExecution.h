#ifndef dmgLeavesOfExecution_h
#define dmgLeavesOfExecution_h

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

/// Values that a filter keeps for the leaves of a composite dataset, which the pipeline hands it one after the other in each
/// execution. A leaf is known by its content, not by its place. A dataset by itself is the only leaf.
///
/// A leaf of new content takes over the value of the leaf that stood in its position in the last execution, so that a surface
/// that changes with time has one value.
template <class Value>
class LeavesOfExecution
{
public:
  /// Another execution: the next leaf is its first one. Calls \p forget for the values of leaves that the last execution did
  /// not have, before they go; one that had none at all, as where a property was out of its range, takes none away.
  template <class Forget>
  void Begin(const Forget& forget)
  {
    const std::size_t size = this->Next == 0 ? this->Leaves.size() : std::min(this->Leaves.size(), this->Next);
    for (std::size_t i = size; i < this->Leaves.size(); ++i)
    {
      forget(*this->Leaves[i].Result);
    }
    this->Leaves.resize(size);
    this->Next = 0;
  }

  /// The value of the next leaf: that of the same content, if there is one.
  /// \param mayAdd whether there is room for one more value. Else the last one is taken over, and those before it stay.
  Value& Of(const std::string& content, bool mayAdd)
  {
    const auto hasContent = [&content](const Leaf& leaf) { return leaf.Content == content; };
    const auto known = std::find_if(this->Leaves.begin(), this->Leaves.end(), hasContent);
    if (known - this->Leaves.begin() < static_cast<std::ptrdiff_t>(this->Next)) // a twin of one of this execution
    {
      return *known->Result;
    }
    if (known != this->Leaves.end())
    {
      std::swap(this->Leaves[this->Next], *known);
    }
    else if (this->Leaves.empty() || (this->Next == this->Leaves.size() && mayAdd))
    {
      this->Leaves.push_back({ "", std::make_unique<Value>() });
    }
    const std::size_t place = std::min(this->Next, this->Leaves.size() - 1);
    this->Leaves[place].Content = content;
    this->Next = place + 1;
    return *this->Leaves[place].Result;
  }

  /// Calls visit for the value of each leaf.
  template <class Visit>
  void ForEach(const Visit& visit) const
  {
    for (const Leaf& leaf : this->Leaves)
    {
      visit(*leaf.Result);
    }
  }

private:
  struct Leaf
  {
    std::string Content;
    std::unique_ptr<Value> Result;
  };
  std::vector<Leaf> Leaves;
  std::size_t Next = 0; ///< leaves of this execution so far
};

}

#endif
