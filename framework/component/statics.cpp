#include "framework/component/statics.h"
