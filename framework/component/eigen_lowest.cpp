#include "framework/component/eigen_lowest.h"
