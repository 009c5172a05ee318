#ifndef dmgRefusals_h
#define dmgRefusals_h

#include "TestTools.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dmg::test
{

/// One error with these words, and nothing else.
inline void ExpectRefusal(vtkAlgorithm* filter, const std::vector<std::string>& words)
{
  const Messages messages(filter);
  filter->Update();
  for (const std::string& word : words)
  {
    EXPECT_NE(messages.Error().find(word), std::string::npos) << "'" << word << "' is not in: " << messages.Error();
  }
  EXPECT_EQ(messages.GetErrors().size(), 2u); // and that of the executive, that the filter failed
  EXPECT_EQ(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), 0);
}

/// No error.
inline void ExpectOutput(vtkAlgorithm* filter)
{
  const Messages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.Error(), "");
  EXPECT_GT(filter->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::CELL), 0);
}

}

#endif
