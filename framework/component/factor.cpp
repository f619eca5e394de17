#include "framework/component/factor.h"
