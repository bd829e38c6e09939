"""Accelerations and multipliers of Andrews' squeezer at the published angles and rates, to 50 digits.

Bodies by where they are (points and angles), derivatives by central differences of steps 1e-15 and 1e-12, and the
saddle system [M, -G^T; G, 0] for accelerations and multipliers. `python3 tests/reference/squeezer.py` prints what
`tests/tests/holonomic/squeezer.rs` compares with.
"""

from mpmath import mp, mpf, matrix, cos, sin, sqrt, lu_solve
mp.dps=50
m=[mpf(x) for x in (".04325",".00365",".02373",".00706",".0705",".00706",".05498")]
I=[mpf(x) for x in ("2.194e-6","4.41e-7","5.255e-6","5.667e-7","1.169e-5","5.667e-7","1.912e-5")]
P=dict(xa="-.06934",ya="-.00227",xb="-.03635",yb=".03273",xc=".014",yc=".072",c0="4530",d=".028",da=".0115",e=".02",ea=".01421",rr=".007",ra=".00092",l0=".07785",ss=".035",sa=".01874",sb=".01043",sc=".018",sd=".02",ta=".02308",tb=".00916",u=".04",ua=".01228",ub=".00449",zf=".02",zt=".04",fa=".01421",mom=".033")
for k,v in P.items(): globals()[k]=mpf(v)
q=[mpf(x) for x in ("15.81077119629904","-15.75637105984298",".04082224013073101","-.5347301163226948",".5244099658805304",".5347301163226948","1.048080741042263")]
v=[mpf(x) for x in ("1139.920302151208","-1424.379294994111","11.03291221937134","19.29337464421385",".5735699284790808","-19.29337464421385",".3231791658026955")]
H=mpf(10)**-15
al=lambda a:(cos(a),sin(a)); ac=lambda a:(sin(a),-cos(a))
add=lambda *t:tuple(map(sum,zip(*t))); mul=lambda k,t:tuple(k*x for x in t)
def pts(q):
    b,t,g,p,de,o,ep=q; A=(xa,ya);B=(xb,yb)
    knee=add(A,mul(zt,al(de))); elb=add(A,mul(u,ac(ep)))
    return [mul(ra,al(b)),add(mul(rr,al(b)),mul(-da,al(b+t))),add(B,mul(sb,al(g)),mul(sa,ac(g))),add(knee,mul(e-ea,ac(p+de))),add(A,mul(ta,al(de)),mul(tb,ac(de))),add(elb,mul(zf-fa,al(o+ep))),add(A,mul(ub,al(ep)),mul(ua,ac(ep)))],[b,b+t,g,p+de,de,o+ep,ep]
def flat(q):
    a,b=pts(q); return [x for p in a for x in p]+b
w=[x for mm in m for x in (mm,mm)]+I
def g(q):
    b,t,ga,p,de,o,ep=q; A=(xa,ya);B=(xb,yb)
    hub=add(mul(rr,al(b)),mul(-d,al(b+t)))
    l=[add(B,mul(ss,ac(ga))),add(A,mul(zt,al(de)),mul(e,ac(p+de))),add(A,mul(u,ac(ep)),mul(zf,al(o+ep)))]
    return [hub[i]-x[i] for x in l for i in range(2)]
def V(q):
    h=add((xb,yb),mul(sd,al(q[2])),mul(sc,ac(q[2]))); return [c0/2*(sqrt((h[0]-xc)**2+(h[1]-yc)**2)-l0)**2]
def grad(f,q):
    r=[]
    for i in range(7):
        a=list(q);b=list(q);a[i]+=H;b[i]-=H
        r.append([(x-y)/(2*H) for x,y in zip(f(a),f(b))])
    return [[r[i][k] for i in range(7)] for k in range(len(r[0]))]
def acc2(f):  # J' q' : second difference along v
    s=mpf(10)**-12
    a=f([x+s*y for x,y in zip(q,v)]);b=f(q);c=f([x-s*y for x,y in zip(q,v)])
    return [(x-2*y+z)/s**2 for x,y,z in zip(a,b,c)]
J=grad(flat,q);G=grad(g,q);bj=acc2(flat);bg=acc2(g);gV=grad(V,q)[0]
S=matrix(13,13);R=matrix(13,1)
for i in range(7):
    for k in range(7): S[i,k]=sum(w[r]*J[r][i]*J[r][k] for r in range(21))
    R[i]=(mom if i==0 else 0)-gV[i]-sum(w[r]*J[r][i]*bj[r] for r in range(21))
    for c in range(6): S[7+c,i]=G[c][i]; S[i,7+c]=-G[c][i]
for c in range(6): R[7+c]=-bg[c]
x=lu_solve(S,R)
print([mp.nstr(x[i],14) for i in range(13)])
print("position residuals",[mp.nstr(t,3) for t in g(q)]); print("velocity residuals",[mp.nstr(sum(a*b for a,b in zip(r,v)),3) for r in G])
