; expect: 900014 at line 2
(nothing but comments)
